// What ci/robustness does. Usage: robustness.mjs PROGRAM FOLDER RUNS SEED
import { spawn } from "node:child_process";
import { mkdirSync, rmSync, writeFileSync } from "node:fs";
import { availableParallelism } from "node:os";
import { join } from "node:path";

import { exr } from "./exr.mjs";

const [program, folder, runs, seed] = process.argv.slice(2);

/** Mulberry32: a small generator with a seed, for choices that nobody bets on. */
function randomNumbers(state) {
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const integer = (random, from, to) => from + Math.floor(random() * (to - from + 1));
const pick = (random, list) => list[integer(random, 0, list.length - 1)];

/** Light of pixel (x, y) of a picture of this size, by kinds that have broken gates. */
const kinds = {
  lamps: (random, [w, h]) => lamps(random, w, h, () => false),
  mirrored: (random, [w, h]) => lamps(random, w, h, () => true),
  sky: (random) => {
    const numbers = new Map();
    return (x, y) => {
      const key = `${x},${y}`;
      if (!numbers.has(key)) numbers.set(key, Math.exp(8 * random()));
      return numbers.get(key);
    };
  },
  rows: (random) => {
    const dark = [integer(random, 2, 5), integer(random, 0, 4)];
    return (x, y) => (y % dark[0] === dark[1] % dark[0] ? 0 : 1 + x);
  },
  columns: (random) => {
    const dark = [integer(random, 2, 5), integer(random, 0, 4)];
    return (x, y) => (x % dark[0] === dark[1] % dark[0] ? 0 : 1 + y);
  },
  poles: (random, [, h]) => {
    const bright = pick(random, [[0], [h - 1], [0, h - 1]]);
    const contrast = 10 ** integer(random, 0, 6);
    const sky = pick(random, [0, 1]);
    return (x, y) => (bright.includes(y) ? contrast : sky);
  },
  constant: () => () => 1,
};

function lamps(random, w, h, isMirrored) {
  const places = new Map();
  for (let i = integer(random, 1, 3); i > 0; --i) {
    const [x, y, light] = [integer(random, 0, w - 1), integer(random, 0, h - 1), Math.exp(6 * random())];
    places.set(`${x},${y}`, light);
    if (isMirrored()) places.set(`${x},${h - 1 - y}`, light);
  }
  const sky = pick(random, [0, 0, 1e-3]);
  return (x, y) => places.get(`${x},${y}`) ?? sky;
}

const colours = [[1, 1, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0.2, 0.5, 1]];

/** A map, and how the gate is run on it. */
function makeCase(number) {
  const random = randomNumbers(Number(seed) * 1000003 + number);
  const height = integer(random, 1, 35);
  const size = pick(random, [[2 * height, height], [integer(random, 1, 70), height]]);
  const kind = pick(random, Object.keys(kinds));
  const light = kinds[kind](random, size);
  const colour = pick(random, colours);
  const exponent = pick(random, [0, 0, 0, -9, 9, -37, -41, 24]);
  const picture = exr(size, (x, y) => colour.map((c) => Math.fround(light(x, y) * c * 10 ** exponent)));
  const file = join(folder, `${number}-${kind}.exr`);
  const samples = 2 ** integer(random, 10, 19);
  const words = ["gate", file, "--any-aspect", "-n", samples, "--seed", integer(random, 1, 2 ** 30), "-t", 1];
  return { file, picture, words: words.map(String) };
}

function runCase(number) {
  const { file, picture, words } = makeCase(number);
  writeFileSync(file, picture);
  return new Promise((resolve) => {
    let text = "";
    const child = spawn(program, words);
    child.stdout.on("data", (part) => (text += part));
    child.stderr.on("data", (part) => (text += part));
    child.on("close", (code, signal) => {
      // Light that a float cannot hold leaves a black map: bad input, and said so.
      const isBlack = code === 2 && /black/.test(text);
      const passed = code === 0 || code === 3 || isBlack;
      if (passed) rmSync(file);
      else console.log(`${[program, ...words].join(" ")}: ${signal ?? code}\n${text.slice(-1500)}`);
      resolve(passed ? (isBlack ? "black" : String(code)) : "failed");
    });
  });
}

mkdirSync(folder, { recursive: true });
const counts = {};
let next = 0;
async function work() {
  while (next < Number(runs)) {
    const outcome = await runCase(next++);
    counts[outcome] = (counts[outcome] ?? 0) + 1;
  }
}
await Promise.all(Array.from({ length: availableParallelism() }, work));
const { 0: accepted = 0, 3: inconclusive = 0, black = 0, failed = 0 } = counts;
console.log(`${runs} runs: ${accepted} accepted, ${inconclusive} inconclusive, ${black} of black maps, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
