// What ci/load does. Usage: load.mjs PROGRAM FOLDER PART… [-- OPTION…]
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { exr, writeLargeExr } from "./exr.mjs";

const [program, folder, ...rest] = process.argv.slice(2);
const end = rest.includes("--") ? rest.indexOf("--") : rest.length;
const parts = rest.slice(0, end);
const options = rest.slice(end + 1);
/** Of resident memory of the program and what it starts, in bytes. */
const kMost = 8e9;
const kLarge = [16384, 8192];
/** Memory of many maps over that of few, which fill what a run keeps: next to 1 but for their records. */
const kFlat = 1.5;
const kFew = 100;
const kMany = 1000;

const gigabytes = (bytes) => `${(bytes / 1e9).toFixed(2)} GB`;

/** A lognormal sky with a sun of 1e5 times its brightness: a hard map of any size, from a generator of
 * its own (mulberry32). */
function largeMap(file) {
  let state = 1;
  const random = () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
  // One row of noise, read from another place for every row.
  const [w, h] = kLarge;
  const noise = Float32Array.from({ length: 2 * w }, () =>
    Math.exp(Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random())));
  writeLargeExr(file, kLarge, (y) => {
    const start = Math.floor(random() * w);
    const sky = Float32Array.from(noise.subarray(start, start + w));
    if (Math.abs(y - h / 4) < 16) sky.fill(1e5, w / 3, w / 3 + 32);
    return [sky, sky, sky];
  });
}

const numberIn = (text, name) => Number(new RegExp(`^${name}:\\s+(\\d+)`, "m").exec(text)?.[1] ?? 0);

function statusOf(id) {
  try {
    return readFileSync(`/proc/${id}/status`, "utf8");
  } catch {
    return "";
  }
}

/** Resident memory of a process and all below it, in bytes: shared pages count for each. */
function residentBytes(root) {
  const parents = new Map();
  const bytes = new Map();
  for (const id of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    const status = statusOf(id);
    parents.set(Number(id), numberIn(status, "PPid"));
    bytes.set(Number(id), 1024 * numberIn(status, "VmRSS"));
  }
  const isBelow = (id) => id === root || (parents.has(id) && id > 1 && isBelow(parents.get(id)));
  return [...bytes].filter(([id]) => isBelow(id)).reduce((sum, [, own]) => sum + own, 0);
}

/** Runs the program; the largest memory of each stage, which its lines of progress name. */
function run(words) {
  return new Promise((resolve) => {
    const start = Date.now();
    const child = spawn(program, [...words, ...options, "--progress", "1"], { stdio: ["ignore", "ignore", "pipe"] });
    const peaks = new Map();
    let stage = "reading";
    let said = "";
    const look = setInterval(() => {
      peaks.set(stage, Math.max(peaks.get(stage) ?? 0, residentBytes(child.pid)));
    }, 50);
    child.stderr.on("data", (text) => {
      said += text;
      const lines = [...said.matchAll(/^(.+): (?:\d+ %|done in)/gm)];
      if (lines.length > 0) stage = lines.at(-1)[1];
    });
    child.on("close", (code, signal) => {
      clearInterval(look);
      const peak = Math.max(...peaks.values());
      resolve({ code: signal ?? code, said, peaks, peak, seconds: (Date.now() - start) / 1000 });
    });
  });
}

let failed = false;
function fail(text) {
  console.log(`  FAILED: ${text}`);
  failed = true;
}

async function measure(name, words, accepted = [0]) {
  console.log(`${name}: lightproof ${[...words.slice(0, 10), words.length > 10 ? "…" : "", ...options].join(" ")}`);
  const found = await run(words);
  if (!accepted.includes(found.code)) fail(`ended with ${found.code}\n${found.said.slice(-2000)}`);
  for (const [stage, peak] of found.peaks) console.log(`  ${stage}: ${gigabytes(peak)}`);
  console.log(`  at most ${gigabytes(found.peak)}, in ${found.seconds.toFixed(0)} s`);
  return found;
}

async function within(name, words) {
  const found = await measure(name, words);
  if (found.peak > kMost) fail(`${gigabytes(found.peak)} are more than ${gigabytes(kMost)}`);
}

const large = join(folder, "large.exr");
function makeLarge() {
  if (existsSync(large)) return large;
  console.log(`making ${large}, ${kLarge.join("x")}`);
  largeMap(`${large}.part`);
  spawnSync("mv", [`${large}.part`, large]);
  return large;
}
function empty(name) {
  const path = join(folder, name);
  rmSync(path, { recursive: true, force: true });
  return path;
}

/** Maps that differ, each 0.4 MB as float RGB: all of them together are many times what a run keeps. */
function smallMaps(count) {
  const small = join(folder, "small");
  mkdirSync(small, { recursive: true });
  return Array.from({ length: count }, (_, i) => {
    const file = join(small, `map-${i}.exr`);
    if (!existsSync(file)) {
      writeFileSync(file, exr([256, 128], (x, y) => [1 + ((x * 7 + y * 13 + i) % 32), 1 + (i % 5), 1]));
    }
    return file;
  });
}

async function many(name, words) {
  const few = await measure(`${kFew} maps, ${name}`, [...words, ...smallMaps(kFew)]);
  const all = await measure(`${kMany} maps, ${name}`, [...words, ...smallMaps(kMany)]);
  const ratio = all.peak / few.peak;
  console.log(`  ${ratio.toFixed(2)} times the memory`);
  if (ratio > kFlat) fail(`memory grows with the number of maps`);
}

const all = {
  gate: () => within("gate", ["gate", makeLarge(), "-n", "2^22"]),
  precompute: () => within("precompute", ["precompute", makeLarge(), "-o", empty("maps"), "--check"]),
  study: () => within("study", ["study", makeLarge(), "-o", empty("study"), "-n", "2^20",
    "--no-throughput", "--no-self-test", "--no-regimes", "--no-stability"]),
  maps: async () => {
    await many("info", ["info"]);
    await many("gate", ["gate", "-n", "1024", "--must-detect", "10", "--sampler", "alias"]);
  },
  samples: async () => {
    const file = join(folder, "samples.json");
    await measure("samples", ["gate", "sun-sky", "--size", "64x32", "--sampler", "alias", "-n",
      "10000000000", "--json", file]);
    const tests = JSON.parse(readFileSync(file, "utf8")).tests;
    const most = Math.max(...tests.map((test) => test.samples));
    console.log(`  tests of up to ${most} samples, ${tests.filter((t) => t.outcome === "reject").length} rejected`);
    if (most < 1e10) fail("no test counted 1e10 samples");
  },
};

mkdirSync(folder, { recursive: true });
for (const part of parts.length > 0 ? parts : Object.keys(all)) await all[part]();
process.exit(failed ? 1 : 0);
