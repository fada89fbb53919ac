// The work of ci/mutation, which says what it is for.
//
// usage: mutation.mjs copy COPY < NAMES
//        mutation.mjs count COPY FOLDERS ONLY
//        mutation.mjs run COPY FOLDERS ONLY BUILD MINUTES SEED
import { spawn } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, lstatSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";

// The sources are formatted: binary operators stand between spaces, and so neither brackets of
// templates nor signs, references and pointers look like one.
const operators = {
  "+": ["-"],
  "-": ["+"],
  "*": ["/"],
  "/": ["*"],
  "+=": ["-="],
  "-=": ["+="],
  "*=": ["/="],
  "/=": ["*="],
  "<": ["<=", ">"],
  "<=": ["<", ">"],
  ">": [">=", "<"],
  ">=": [">", "<"],
  "==": ["!="],
  "!=": ["=="],
  "&&": ["||"],
  "||": ["&&"],
};
const words = {
  true: ["false"],
  false: ["true"],
  min: ["max"],
  max: ["min"],
  Min: ["Max"],
  Max: ["Min"],
  Add: ["Sub"],
  Sub: ["Add"],
  Lt: ["Le"],
  Le: ["Lt"],
  Gt: ["Ge"],
  Ge: ["Gt"],
};
const constants = {
  0: ["1"],
  1: ["0", "2"],
  2: ["1", "3"],
  "0.0": ["1.0"],
  "0.5": ["1.0", "0.25"],
  "1.0": ["0.0", "2.0"],
  "2.0": ["1.0", "0.5"],
};
const patterns = [
  { expression: /(?<=\s)([-+*/]=?|[<>]=?|[=!]=|&&|\|\|)(?=\s)/g, table: operators },
  { expression: /(?<=\b(?:std|hn)::)(min|max|Min|Max|Add|Sub|Lt|Le|Gt|Ge)(?=\()/g, table: words },
  { expression: /\b(true|false)\b/g, table: words },
  { expression: /(?<![\w.])(0\.0|0\.5|1\.0|2\.0|[012])(?=[uUfF]?(?![\w.']))/g, table: constants },
  { expression: /(?<![\w!])(!)(?=[\w(])/g, table: { "!": [""] } },
];

const blank = (text) => text.replace(/[^\n]/g, " ");

/**
 * The source with spaces for what is not to be changed: comments, strings, directives, assertions,
 * branches for processors without vectors.
 */
function code(text) {
  return text
    .replace(/R"\((?:.|\n)*?\)"|\/\/[^\n]*|\/\*(?:.|\n)*?\*\/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+'/g, (part) =>
      /^'\d/.test(part) ? part : blank(part))
    .replace(/^#if HWY_TARGET == HWY_SCALAR\n(?:.|\n)*?^#(?=else|endif)/gm, blank)
    .replace(/^\s*#(?:.*\\\n)*.*$/gm, blank)
    .replace(/\b(?:static_)?assert\((?:[^;]|\n)*?\);/g, blank);
}

const places = { reference: "reference" };
const placeOf = (folder) => places[folder] ?? join("src", "lightproof", folder);

function sourcesOf(copy, folder) {
  const place = placeOf(folder);
  if (!existsSync(join(copy, place))) {
    console.error(`mutation: there is no folder ${place}`);
    process.exit(2);
  }
  return readdirSync(join(copy, place))
    .filter((name) => /\.(?:cpp|h)$/.test(name))
    .sort()
    .map((name) => join(place, name));
}

/** Every change that may be made to a file: { path, folder, line, at, before, after: [..] }. */
function sitesOf(copy, folder, path) {
  const text = readFileSync(join(copy, path), "utf8");
  if (/\bkill\(|\bremove_all\(/.test(text)) return [];
  const masked = code(text);
  const found = [];
  for (const { expression, table } of patterns) {
    for (const match of masked.matchAll(expression)) {
      const line = text.slice(0, match.index).split("\n").length;
      found.push({ path, folder, line, at: match.index, before: match[1], after: table[match[1]] });
    }
  }
  return found;
}

function allSites(copy, folders, only) {
  const wanted = new RegExp(only);
  return folders
    .split(",")
    .flatMap((folder) => sourcesOf(copy, folder).flatMap((path) => sitesOf(copy, folder, path)))
    .filter(({ path, line }) => wanted.test(`${path}:${line}`));
}

/** Random whole numbers below a bound, the same for the same seed. */
function randomNumbers(seed) {
  let drawn = 0;
  return (bound) => {
    const hash = createHash("sha256").update(`mutation ${seed} ${drawn++}`).digest();
    return Number(hash.readBigUInt64LE() % BigInt(bound));
  };
}

function shuffle(items, random) {
  for (let i = items.length - 1; i > 0; --i) {
    const j = random(i + 1);
    [items[i], items[j]] = [items[j], items[i]];
  }
  return items;
}

/** Writes what differs only, so that only this is compiled again, and removes what is gone. */
function copyTree(copy) {
  const isFile = (name) => name && existsSync(name) && lstatSync(name).isFile();
  const names = readFileSync(0, "utf8").split("\0").filter(isFile);
  for (const name of names) {
    const to = join(copy, name);
    const content = readFileSync(name);
    if (existsSync(to) && readFileSync(to).equals(content)) continue;
    mkdirSync(dirname(to), { recursive: true });
    writeFileSync(to, content);
  }
  const kept = new Set(names);
  for (const entry of readdirSync(copy, { recursive: true, withFileTypes: true })) {
    const name = join(entry.parentPath ?? entry.path, entry.name).slice(copy.length + 1);
    if (!name.startsWith("build/") && entry.isFile() && !kept.has(name)) rmSync(join(copy, name));
  }
}

/** Runs a command; its status, or "timeout" after so many seconds, when it and its children end. */
function run(command, seconds, environment = {}) {
  return new Promise((done) => {
    const child = spawn(command[0], command.slice(1), {
      stdio: "ignore",
      detached: true,
      env: { ...process.env, ...environment },
    });
    let late = false;
    const timer = setTimeout(() => {
      late = true;
      process.kill(-child.pid, "SIGKILL");
    }, 1000 * seconds);
    child.on("close", (status) => {
      clearTimeout(timer);
      done(late ? "timeout" : (status ?? "signal"));
    });
  });
}

class Trial {
  constructor(copy, build) {
    this.copy = copy;
    this.build = build;
    this.temporary = resolve(copy, "build", "temporary");
    this.seconds = new Map(); // that the unchanged tests of a folder take
    mkdirSync(this.temporary, { recursive: true });
  }

  compile(folder) {
    return run(["cmake", "--build", this.build, "--target", `${folder}_tests`], 1800);
  }

  /** A program whose memory or output runs away ends itself. */
  test(folder, seconds) {
    const program = join(this.build, "tests", `${folder}_tests`);
    const script = 'ulimit -v 8000000 -f 4000000 -c 0; exec "$0" --gtest_fail_fast --gtest_brief=1';
    return run(["bash", "-c", script, program], seconds, { TMPDIR: this.temporary });
  }

  /** Throws if the unchanged tests fail. */
  async measure(folder) {
    const start = Date.now();
    if ((await this.compile(folder)) !== 0 || (await this.test(folder, 1800)) !== 0) {
      throw new Error(`the unchanged tests of ${folder} fail`);
    }
    this.seconds.set(folder, (Date.now() - start) / 1000);
  }

  /** "noticed", "survived", "not built" or "timed out". */
  async judge({ path, folder, at, before, change }) {
    if (!this.seconds.has(folder)) await this.measure(folder);
    const file = join(this.copy, path);
    const text = readFileSync(file, "utf8");
    writeFileSync(file, text.slice(0, at) + change + text.slice(at + before.length));
    try {
      const built = await this.compile(folder);
      if (built !== 0) return built === "timeout" ? "timed out" : "not built";
      const passed = await this.test(folder, 20 + 4 * this.seconds.get(folder));
      if (passed === "timeout") return "timed out";
      return passed === 0 ? "survived" : "noticed";
    } finally {
      writeFileSync(file, text);
    }
  }
}

function describe({ path, line, at, before, change }, copy) {
  const text = readFileSync(join(copy, path), "utf8");
  const start = text.lastIndexOf("\n", at - 1) + 1;
  const end = text.indexOf("\n", at);
  const shown = `${text.slice(start, at)}[${before} -> ${change || "nothing"}]`;
  return `${path}:${line}: ${(shown + text.slice(at + before.length, end)).trim()}`;
}

async function runAll(copy, folders, only, build, minutes, seed) {
  const random = randomNumbers(seed);
  const queue = shuffle(allSites(copy, folders, only), random);
  const trial = new Trial(copy, build);
  const end = Date.now() + 60000 * Number(minutes);
  const results = [];
  for (const site of queue) {
    if (Date.now() > end) break;
    const change = site.after[random(site.after.length)];
    const mutant = { ...site, change };
    const start = Date.now();
    const text = describe(mutant, copy);
    const verdict = await trial.judge(mutant);
    const seconds = Math.round((Date.now() - start) / 1000);
    console.log(`${verdict.padEnd(9)} ${String(seconds).padStart(4)} s  ${text}`);
    results.push({ verdict, seconds, text });
    writeFileSync(`${copy}.json`, JSON.stringify(results, null, 1));
  }
  report(results, queue.length);
}

function report(results, sites) {
  const count = (verdict) => results.filter((result) => result.verdict === verdict).length;
  console.log(`\n${results.length} of ${sites} changes: ${count("noticed")} noticed, ` +
    `${count("timed out")} timed out, ${count("not built")} not built, ` +
    `${count("survived")} survived${count("survived") ? ":" : ""}`);
  for (const { verdict, text } of results) if (verdict === "survived") console.log(`  ${text}`);
}

const [task, copy, folders, only, build, minutes, seed] = process.argv.slice(2);
if (task === "copy") copyTree(copy);
if (task === "count") console.log(allSites(copy, folders, only).length);
if (task === "run") await runAll(copy, folders, only, build, minutes, seed);
