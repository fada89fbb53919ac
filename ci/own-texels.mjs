// What ci/own-texels does. Usage: own-texels.mjs PROGRAM FOLDER SEED|random SAMPLES
import { execFileSync, spawnSync } from "node:child_process";
import { randomInt } from "node:crypto";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { exr } from "./exr.mjs";

const [program, folder, chosen, samples] = process.argv.slice(2);
const seed = chosen === "random" ? String(randomInt(2 ** 47)) : chosen;
/** What ci/diagnosis asks for: nine of ten by their right name. */
const kMostUnknown = 0.1;
const options = { encoding: "utf8", maxBuffer: 2 ** 30 };

/** Light of a texel, a share x of the width from the left and y of the height from the bottom: what
 * mutants need, a dark first row, a sun, and colours. */
function light(x, y, isFirstRow) {
  if (isFirstRow) return [0, 0, 0];
  const sky = 3e-4 * (0.1 + y) * (1 + 0.5 * Math.sin(2 * Math.PI * x + 1));
  const sun = Math.abs(x - 0.7) < 0.02 && Math.abs(y - 0.7) < 0.04 ? 40 : 1;
  const warm = x < 1 / 3 ? 1.6 : 1;
  return [warm, 1, 1 / warm].map((colour) => sky * sun * colour);
}

/** A picture of w x h texels, the first of which may stand once more behind the last of a row. */
const picture = (w, h, repeats = 0) =>
  exr([w + repeats, h], (x, y) => light((x % w) / w, (h - 1 - y) / h, y === h - 1));

/** Faces below each other, of what they are side by side. */
const column = (size) =>
  exr([size, 6 * size], (x, y) => {
    const row = y % size;
    return light((x + size * Math.floor(y / size)) / (6 * size), (size - 1 - row) / size, row === size - 1);
  });

const maps = [
  { name: "octahedral", preset: "pbrt-v4", picture: picture(64, 64) },
  { name: "cube-strip", preset: "cube", picture: picture(96, 16) },
  { name: "cube-column", preset: "cube", picture: column(16) },
  { name: "nodes", preset: "openexr", picture: picture(64, 33, 1) },
  { name: "shifted", preset: "z-up-half-turn", picture: picture(63, 32) },
];

function gate(map, ...words) {
  const file = join(folder, `${map.name}.exr`);
  const all = ["gate", file, "--preset", map.preset, "--any-aspect", ...words,
    "--seed", seed, "-n", samples, "--json", "-", "-q"];
  const { status, stdout, stderr } = spawnSync(program, all, options);
  if (status !== 0 && status !== 1 && status !== 3) {
    throw new Error(`${[program, ...all].join(" ")}: ${status}\n${stderr}`);
  }
  return { status, ...JSON.parse(stdout) };
}

const mutants = JSON.parse(execFileSync(program, ["list", "mutants", "--json"], options)).entries
  .filter(({ over }) => over === "map");
const asSamplers = mutants.flatMap(({ name }) => ["--sampler", name]);

let passed = true;
function fail(text) {
  passed = false;
  console.log(`  FAILED: ${text}`);
}

/** All samplers and densities: none is rejected. Returns the densities that the mapping has. */
function judgeSamplers(map) {
  const found = gate(map);
  console.log(`${map.name}: all samplers: ${found.outcome}, ${found.tests.length} tests, ` +
    `${found.left_out.length} left out`);
  if (found.status !== 0) {
    for (const { sampler, density, looks_like: name } of found.rejections) fail(`${sampler} ${density}: ${name}`);
    if (found.rejections.length === 0) fail(found.outcome);
  }
  return ["A", "B", "C"].filter((label) => found.tests.some(({ density }) => density === label));
}

/** All mutants under a density: what is not left out is rejected, by its name. */
function judgeMutants(map, density) {
  const found = gate(map, ...asSamplers, "--density", density);
  const leftOut = new Set(found.left_out.map(({ sampler }) => sampler));
  const names = new Map(found.rejections.map((each) => [each.sampler, each.looks_like]));
  const judged = mutants.filter(({ name }) => !leftOut.has(name));
  let unknown = 0;
  for (const { name, diagnosis } of judged) {
    const given = names.get(name);
    if (given === undefined) fail(`${name} ${density} is not rejected`);
    else if (given === "unknown") ++unknown;
    else if (given !== diagnosis) fail(`${name} ${density}: ${given} instead of ${diagnosis}`);
  }
  if (unknown > kMostUnknown * judged.length) fail(`${unknown} have no name`);
  console.log(`${map.name}: mutants of ${density}: ${judged.length} judged, ${unknown} rejected without a name, ` +
    `${leftOut.size} left out`);
}

mkdirSync(folder, { recursive: true });
console.log(`seed ${seed}`);
for (const map of maps) {
  writeFileSync(join(folder, `${map.name}.exr`), map.picture);
  for (const density of judgeSamplers(map)) judgeMutants(map, density);
}
process.exit(passed ? 0 : 1);
