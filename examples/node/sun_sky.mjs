// The map `sun-sky`, which Lightproof has built in: a sky, and a sun of 3 x 3 texels.

/** Radiance as {width, height, rgb}: three floats a texel, row by row from the bottom. */
export function sunSky(width, height) {
  const rgb = new Float32Array(3 * width * height);
  const sunColumn = Math.floor(width / 4);
  const sunRow = Math.floor((5 * height) / 6);
  for (let y = 0; y < height; ++y) {
    const sky = 1 + 0.5 * Math.cos(Math.PI * (1 - (y + 0.5) / height));
    for (let x = 0; x < width; ++x) {
      const isSun = Math.abs(x - sunColumn) <= 1 && Math.abs(y - sunRow) <= 1;
      rgb.set(isSun ? [1e5, 0.9e5, 0.7e5] : [0.3 * sky, 0.5 * sky, sky], 3 * (y * width + x));
    }
  }
  return { width, height, rgb };
}
