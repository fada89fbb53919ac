#!/usr/bin/env python3
"""A sampler of an environment map in NumPy, and its samples as a dump for `lightproof check`.

The map is `sun-sky`, which Lightproof has built in, so that nothing has to be read here:

  python3 draw_samples.py samples.npy
  lightproof check samples.npy --map sun-sky --size 128x64

The map's texels are drawn in proportion to luminance times solid angle, and positions uniformly
inside them, as most renderers do: density C, which `check` expects unless it is told otherwise. A
row of the dump is a direction (a unit vector, z up) and its density per steradian, four floats.
"""
import argparse

import numpy as np

WIDTH, HEIGHT = 128, 64
REC709 = np.array([0.2126, 0.7152, 0.0722])


def sun_sky(width, height):
    """Radiance of shape (height, width, 3), row 0 at the bottom: a sky, and a sun of 3 x 3 texels."""
    theta = np.pi * (1.0 - (np.arange(height) + 0.5) / height)
    sky = (1.0 + 0.5 * np.cos(theta))[:, None, None] * np.array([0.3, 0.5, 1.0])
    radiance = np.repeat(sky, width, axis=1)
    row, column = 5 * height // 6, width // 4
    radiance[row - 1:row + 2, column - 1:column + 2] = 1e5 * np.array([1.0, 0.9, 0.7])
    return radiance


class EnvironmentSampler:
    """Draws texels by inversion of the sums of their masses."""

    def __init__(self, radiance, forget_sine=False):
        self.height, self.width = radiance.shape[:2]
        mass = radiance @ REC709
        if not forget_sine:
            # A row's texels have solid angles in proportion to the sine at its centre.
            theta = np.pi * (1.0 - (np.arange(self.height) + 0.5) / self.height)
            mass = mass * np.sin(theta)[:, None]
        self.mass = (mass / mass.sum()).ravel()
        self.sums = np.cumsum(self.mass)
        self.sums /= self.sums[-1]

    def sample(self, u):
        """Directions and densities per steradian for random numbers of shape (N, 3) in [0,1)."""
        texel = np.searchsorted(self.sums, u[:, 0], side="right")
        s = (texel % self.width + u[:, 1]) / self.width
        t = (texel // self.width + u[:, 2]) / self.height
        phi = np.pi - 2.0 * np.pi * s
        theta = np.pi * (1.0 - t)
        sine = np.sin(theta)
        direction = np.stack([sine * np.cos(phi), sine * np.sin(phi), np.cos(theta)], axis=1)
        per_square = self.mass[texel] * self.width * self.height
        # d(omega) = 2 pi^2 sin(theta) ds dt
        return direction, per_square / (2.0 * np.pi**2 * sine)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dump", metavar="DUMP.npy", help="the file to write")
    parser.add_argument("--count", type=int, default=1 << 20, help="samples (default 2^20)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--forget-sine", action="store_true",
                        help="a defect, to see it found: texels are drawn by luminance alone")
    arguments = parser.parse_args()
    sampler = EnvironmentSampler(sun_sky(WIDTH, HEIGHT), arguments.forget_sine)
    u = np.random.default_rng(arguments.seed).random((arguments.count, 3))
    direction, pdf = sampler.sample(u)
    np.save(arguments.dump, np.column_stack([direction, pdf]).astype("<f4"))


if __name__ == "__main__":
    main()
