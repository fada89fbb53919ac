// A sampler of an environment map in JavaScript, and its samples as a dump for `lightproof check`.
// Usage: node draw_samples.mjs DUMP.f32 [--count N] [--seed S] [--flip]
//
//   node draw_samples.mjs samples.f32
//   lightproof check samples.f32 --map sun-sky --size 128x64
//
// A row of the dump is a position in the picture (u from the left, v from the top) and the density
// per steradian, as floats. What the numbers mean, and that the samples are distributed as radiance
// over solid angle (density B), stands in a file beside the dump, which `check` reads:
// DUMP.f32.json. With --flip, a defect to see found, v counts from the bottom.
import { createCipheriv } from "node:crypto";
import { writeFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { sunSky } from "./sun_sky.mjs";

/** Random numbers in [0,1), of 32 bits each: AES in counter mode, with the seed in its key. */
function randomNumbers(count, seed) {
  const key = Buffer.alloc(16);
  key.writeUInt32LE(seed);
  const bytes = createCipheriv("aes-128-ctr", key, Buffer.alloc(16)).update(Buffer.alloc(4 * count));
  return Float64Array.from({ length: count }, (_, i) => bytes.readUInt32LE(4 * i) * 2 ** -32);
}

/** Draws directions with a density in proportion to radiance: luminance times solid angle. */
class EnvironmentSampler {
  constructor({ width, height, rgb }) {
    this.width = width;
    this.height = height;
    this.luminance = Float64Array.from({ length: width * height }, (_, i) =>
      0.2126 * rgb[3 * i] + 0.7152 * rgb[3 * i + 1] + 0.0722 * rgb[3 * i + 2]);
    this.sums = new Float64Array(width * height + 1);
    for (let i = 0; i < width * height; ++i) {
      this.sums[i + 1] = this.sums[i] + this.luminance[i] * this.solidAngle(Math.floor(i / width));
    }
  }

  /** z = cos(theta) at the lower edge of a row, which is the upper edge of the one below. */
  z(row) {
    return -Math.cos((Math.PI * row) / this.height);
  }

  solidAngle(row) {
    return ((2 * Math.PI) / this.width) * (this.z(row + 1) - this.z(row));
  }

  /** The last texel whose sum of masses before it is not above the value. */
  find(value) {
    let [first, last] = [0, this.sums.length - 1];
    while (last - first > 1) {
      const middle = (first + last) >> 1;
      if (this.sums[middle] <= value) first = middle;
      else last = middle;
    }
    return first;
  }

  /** Position in the picture, s from the left and t from the bottom, and density per steradian. */
  sample(u0, u1, u2) {
    const total = this.sums[this.sums.length - 1];
    const texel = this.find(u0 * total);
    const row = Math.floor(texel / this.width);
    const z = this.z(row) + u2 * (this.z(row + 1) - this.z(row)); // uniform in solid angle
    return {
      s: ((texel % this.width) + u1) / this.width,
      t: Math.acos(-z) / Math.PI,
      pdf: this.luminance[texel] / total,
    };
  }
}

const { values: options, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    count: { type: "string", default: "1048576" },
    seed: { type: "string", default: "1" },
    flip: { type: "boolean", default: false },
  },
});
if (positionals.length !== 1) {
  console.error("usage: node draw_samples.mjs DUMP.f32 [--count N] [--seed S] [--flip]");
  process.exit(2);
}
const [dump] = positionals;
const count = Number(options.count);
const sampler = new EnvironmentSampler(sunSky(128, 64));
const random = randomNumbers(3 * count, Number(options.seed));
const rows = new Float32Array(3 * count);
for (let i = 0; i < count; ++i) {
  const { s, t, pdf } = sampler.sample(random[3 * i], random[3 * i + 1], random[3 * i + 2]);
  rows.set([s, options.flip ? t : 1 - t, pdf], 3 * i);
}
writeFileSync(dump, rows);
writeFileSync(`${dump}.json`, JSON.stringify({ columns: ["u", "v", "pdf"], density: "B" }) + "\n");
