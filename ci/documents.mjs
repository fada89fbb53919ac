// The commands of the documents, run or looked up; see ci/documents.
// Usage: node documents.mjs BUILD PREFIX FOLDER THOROUGH ONLY
import { execFileSync, spawnSync } from "node:child_process";
import { chmodSync, copyFileSync, cpSync, existsSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { sunSky } from "../examples/node/sun_sky.mjs";
import { exr } from "./exr.mjs";
import { codeOf, commandsOf, documents, read } from "./markdown.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "..");
const [build, prefix, folder, thorough, only] = process.argv.slice(2);

// What these do is not undone with the folder, or is another script's to try.
const installers = new Set(["apt-get", "cmake", "ctest", "npm", "pip", "podman", "docker", "git", "man", "sudo"]);
const longest = 600_000; // milliseconds of a command

/** A map, samples of it in each form, runs of a benchmark, a renderer: what the documents speak of. */
function furnish() {
  const [width, height] = [128, 64];
  const map = sunSky(width, height);
  // Darker, so that half floats hold it.
  const rgb = map.rgb.map((value) => value / 100);
  const pixel = (x, y) => rgb.subarray(3 * ((height - 1 - y) * width + x)).subarray(0, 3);
  for (const name of ["studio.exr", "sky.exr"]) {
    writeFileSync(join(folder, name), exr([width, height], pixel));
  }
  mkdirSync(join(folder, "maps"));
  mkdirSync(join(folder, "lightproof-report"));
  copyFileSync(join(folder, "studio.exr"), join(folder, "maps", "studio.exr"));
  mkdirSync(join(folder, "build", "release"), { recursive: true });
  for (const program of ["lightproof", "lightproof_bench", "lightproof-decode", "lightproof-plugin-host"]) {
    symlinkSync(join(build, program), join(folder, "build", "release", program));
  }
  cpSync(join(root, "examples"), join(folder, "examples"), { recursive: true });
  mkdirSync(join(folder, "bin"));
  if (!prefix) symlinkSync(join(build, "lightproof"), join(folder, "bin", "lightproof"));
  furnishSamples();
  furnishHistory();
}

/** The Python that has NumPy: not always the first one on the PATH. */
function pythonWithNumpy() {
  const candidates = execFileSync("which", ["-a", "python3"], { encoding: "utf8" }).trim().split("\n");
  const found = candidates.find((python) => spawnSync(python, ["-c", "import numpy"]).status === 0);
  if (!found) throw new Error("no python3 on the PATH has the module numpy; Debian's package is python3-numpy");
  return found;
}

const densityC = `
import sys
import numpy as np
sys.path.insert(0, sys.argv[1])
from draw_samples import HEIGHT, WIDTH, EnvironmentSampler, sun_sky
direction, pdf = EnvironmentSampler(sun_sky(WIDTH, HEIGHT)).sample(np.random.default_rng(1).random((1 << 20, 3)))
np.save("samples.npy", np.column_stack([direction, pdf]).astype("<f4"))
x, y, z = direction[:1 << 18].T
square = pdf[:1 << 18] * 2 * np.pi**2 * np.sqrt(1 - z * z)
rows = np.column_stack([0.5 - np.arctan2(y, x) / (2 * np.pi), np.arccos(z) / np.pi, square])
np.savetxt("samples.csv", rows, delimiter=",")

radiance = sun_sky(WIDTH, HEIGHT) / 100
sampler = EnvironmentSampler(radiance)
column = np.clip(((0.5 - np.arctan2(direction[:, 1], direction[:, 0]) / (2 * np.pi)) * WIDTH).astype(int), 0, WIDTH - 1)
row = np.clip(((1 - np.arccos(direction[:, 2]) / np.pi) * HEIGHT).astype(int), 0, HEIGHT - 1)
weights = radiance[row, column] / pdf[:, None]
np.save("guided.npy", np.column_stack([direction, pdf, weights]).astype("<f4"))

t, s = np.meshgrid((np.arange(HEIGHT) + 0.5) / HEIGHT, (np.arange(WIDTH) + 0.5) / WIDTH, indexing="ij")
densities = sampler.mass.reshape(HEIGHT, WIDTH) * WIDTH * HEIGHT / (2 * np.pi**2 * np.sin(np.pi * t))
np.savetxt("pdf.csv", np.column_stack([s.ravel(), t.ravel(), densities.ravel()]), delimiter=",", header="s,t,pdf", comments="")

u = np.random.default_rng(2).random((1 << 20, 2))
phi, cosine = 2 * np.pi * u[:, 0], np.sqrt(1 - u[:, 1])
sine = np.sqrt(u[:, 1])
diffuse = np.column_stack([sine * np.cos(phi), sine * np.sin(phi), cosine, cosine / np.pi])
np.save("brdf.npy", diffuse.astype("<f4"))
`;

/** samples.npy, samples.csv, guided.npy, brdf.npy, pdf.csv, and a program that prints samples as floats. */
function furnishSamples() {
  const python = pythonWithNumpy();
  execFileSync(python, ["-c", densityC, join(root, "examples", "python")], { cwd: folder });
  const rows = readFileSync(join(folder, "samples.npy"));
  writeFileSync(join(folder, "renderer.f32"), rows.subarray(rows.length - 16 * (1 << 20)));
  const program = (name, text) => {
    writeFileSync(join(folder, "bin", name), `#!/bin/sh\n${text}\n`);
    chmodSync(join(folder, "bin", name), 0o755);
  };
  program("my_renderer", "exec cat renderer.f32");
  program("python3", `exec ${python} "$@"`);
}

/** Two commits in one session, 15 processes each, in turns: base-*.json and head-*.json. */
function furnishHistory() {
  for (let i = 0; i < 15; ++i) {
    for (const [k, commit] of ["base", "head"].entries()) {
      const second = String(2 * i + k).padStart(2, "0");
      const context = {
        date: `2026-01-31T12:00:${second}+00:00`, host_name: "host", num_cpus: 2, commit: commit.toUpperCase(),
      };
      const benchmark = {
        name: "sample", run_name: "sample", run_type: "iteration", repetition_index: 0,
        cpu_time: 100 + ((7 * i + 3 * k) % 5), real_time: 100, time_unit: "ns", iterations: 1,
      };
      writeFileSync(join(folder, `${commit}-${i + 1}.json`), JSON.stringify({ context, benchmarks: [benchmark] }));
    }
  }
}

/** The simple commands of a line, as words; quotes are taken off. */
function simpleCommands(line) {
  const words = line.match(/"[^"]*"|'[^']*'|\S+/g) ?? [];
  const commands = [[]];
  for (const word of words) {
    if (["&&", "||", "|", ";"].includes(word)) commands.push([]);
    else commands.at(-1).push(word.replace(/^["'(]+|["')]+$/g, ""));
  }
  return commands.filter((command) => command.length > 0);
}

const environment = {
  ...process.env,
  HOME: join(folder, "home"),
  PATH: [join(folder, "bin"), ...(prefix ? [join(prefix, "bin")] : []), process.env.PATH].join(":"),
  LIGHTPROOF_CACHE: join(build, "documents"),
  NO_COLOR: "1",
};

const helps = new Map();
function helpOf(words) {
  const key = words.join(" ");
  if (!helps.has(key)) {
    const done = spawnSync(words[0], [...words.slice(1), "--help"], { cwd: root, env: environment, encoding: "utf8" });
    helps.set(key, done.status === 0 ? done.stdout : null);
  }
  return helps.get(key);
}

/** What is wrong with the options of a command whose help is asked for by `caller`. */
function faultsOfOptions(caller, words) {
  const help = helpOf(caller);
  if (help === null) return [`${caller.slice(1).join(" ") || caller[0]} has no help`];
  const names = words.map((word) => word.replace(/^\[|\]$/g, "").replace(/=.*/, ""))
    .filter((word) => /^--?[a-zA-Z]/.test(word));
  return names.filter((name) => !new RegExp(`(^|[\\s,])${name}(?![\\w-])`, "m").test(help))
    .map((name) => `there is no option ${name}`);
}

/** A command of Lightproof with the commands below it: "history add" before its options. */
function callOf(words) {
  const call = [join(build, "lightproof")];
  for (const word of words.slice(1)) {
    if (!/^[a-z-]+$/.test(word) || word.startsWith("-") || !new RegExp(`^  ${word}\\s`, "m").test(helpOf(call) ?? "")) break;
    call.push(word);
  }
  return call;
}

function faultsOfBenchmark(words) {
  const filter = words.filter((word) => word.startsWith("--benchmark_filter="));
  const done = spawnSync(join(build, "lightproof_bench"), ["--benchmark_list_tests", ...filter], { encoding: "utf8" });
  return done.status === 0 && done.stdout.trim() ? [] : [`no benchmark matches ${filter}`];
}

/** What can be said of a command without running it. */
function faultsOf(words) {
  const [program] = words;
  const name = program.replace(/^.*\//, "");
  if (name === "lightproof") {
    const call = callOf(words);
    if (call.length === 1 && words.length > 1 && /^[a-z]/.test(words[1])) return [`there is no command ${words[1]}`];
    return faultsOfOptions(call, words.slice(call.length));
  }
  if (name === "lightproof_bench") return faultsOfBenchmark(words);
  if (/^(\.\/)?ci\//.test(program)) {
    const script = join(root, program);
    if (!existsSync(script)) return [`there is no ${program}`];
    return faultsOfOptions([script], words.slice(1));
  }
  if (["node", "python3"].includes(name)) {
    return existsSync(join(folder, words[1])) ? [] : [`there is no ${words[1]}`];
  }
  if (existsSync(join(root, "examples", `${program}.cpp`))) return []; // what examples/ builds
  return installers.has(name) || ["cd", "my_renderer", "cat"].includes(name) ? [] : [`nobody says how to look up ${name}`];
}

/** Whether a line is looked up and not run. */
function isOnlyLookedUp({ command, comment }) {
  const programs = simpleCommands(command).map(([program]) => program);
  if (programs.some((program) => installers.has(program) || /^(\.\/)?ci\//.test(program))) return true;
  if (/\bby ci\//.test(comment)) return true; // another script runs it
  if (only) return !new RegExp(only).test(command);
  return /^long\b/.test(comment) && !thorough;
}

function run({ command, comment }) {
  const expected = Number(/exit code (\d+)/.exec(comment)?.[1] ?? 0);
  const done = spawnSync("bash", ["-o", "pipefail", "-c", command],
    { cwd: folder, env: environment, encoding: "utf8", timeout: longest, maxBuffer: 1 << 28 });
  if (done.status === expected) return [];
  const end = (done.stdout + done.stderr).trim().split("\n").slice(-15).join("\n");
  return [`ends with ${done.status ?? done.signal}, not ${expected}:\n${end}`];
}

/** Code in prose that begins as a command does. What stands for something is left out. */
function commandsInProse(text) {
  return codeOf(text)
    .filter(({ code }) => /^((build\/release\/)?lightproof [a-z]|(\.\/)?ci\/[a-z])/.test(code) && !/\.\w+$/.test(code.split(" ")[0]))
    .map(({ line, code }) => ({ line, command: code.replace(/…|\.\.\./g, "") }));
}

furnish();
const counts = { run: 0, "looked up": 0, "in the running text": 0 };
const times = [];
let faults = 0;
const report = (page, { line, command }, found) => {
  for (const fault of found) {
    ++faults;
    console.error(`${page}:${line}: ${command}\n  ${fault}`);
  }
};
for (const page of documents(root)) {
  const text = read(root, page);
  for (const entry of commandsOf(text)) {
    const lookedUp = isOnlyLookedUp(entry);
    const start = Date.now();
    report(page, entry, simpleCommands(entry.command).flatMap(faultsOf));
    if (!lookedUp) report(page, entry, run(entry));
    times.push([(Date.now() - start) / 1000, entry.command]);
    ++counts[lookedUp ? "looked up" : "run"];
  }
  for (const entry of commandsInProse(text)) {
    report(page, entry, simpleCommands(entry.command).flatMap(faultsOf));
    ++counts["in the running text"];
  }
}
for (const [seconds, command] of times.sort((a, b) => b[0] - a[0]).slice(0, 5)) {
  console.log(`${seconds.toFixed(1)} s  ${command}`);
}
console.log(Object.entries(counts).map(([name, count]) => `${count} commands ${name}`).join(", "));
process.exitCode = faults > 0 ? 1 : 0;
