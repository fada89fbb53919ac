// clang-tidy over every source file. A file that passed before is skipped while nothing that it is
// made of has changed: its own text, our headers, the compile command, .clang-tidy. Exit 1 if there
// are findings. Arguments name files: only what these belong to is checked. With --deep, paths are
// followed into the functions that are called, which doubles the time: ci/thorough does it.
//
// Files go in groups, as one text each, most of which is the headers: a quarter of the time. What is
// found in a group is looked for again in each of its files alone, so that nobody has to keep names
// apart. They stand in the opposite order of that in which the build takes them, so that an include
// which is missing is missed by one of both; ci/sanitize compiles each on its own.
import { execFile, execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { dirname, join, relative, resolve, sep } from "node:path";
import { fileURLToPath } from "node:url";
import { groupsOf, sourcesOf } from "./unity.mjs";

const isDeep = process.argv.includes("--deep");
const analysis = isDeep ? "mode=shallow" : "mode=shallow,ipa=none";
const root = resolve(dirname(fileURLToPath(import.meta.url)), "..");
const stamps = join(root, "build", "lint");
const build = join(stamps, "commands");
const texts = join(stamps, "groups");
const tidy = "clang-tidy-22";

/** The more files together, the less of the time is that of headers; and the less is checked at once. */
const largestGroup = 20;

const isOurs = (path) => path.startsWith(root + sep);
const isGenerated = (path) => path.startsWith(join(root, "build") + sep);
const isTest = (path) => path.startsWith(join(root, "tests") + sep);
const isProduct = (path) => path.startsWith(join(root, "src") + sep);

/** The commands that compile each source on its own, and the headers that they need generated. */
function configure() {
  const options = ["--preset", "release", "-B", build, "-DLIGHTPROOF_UNITY=OFF"];
  execFileSync("cmake", options, { cwd: root, stdio: ["ignore", "ignore", "inherit"] });
  const commit = ["--build", build, "--target", "lightproof_commit"];
  execFileSync("cmake", commit, { cwd: root, stdio: ["ignore", "ignore", "inherit"] });
}

/** One compile command per source file of the repository, without GCC's precompiled headers. */
function commandsOfSources() {
  const commands = JSON.parse(readFileSync(join(build, "compile_commands.json"), "utf8"));
  const ours = commands.filter(({ file }) => file.endsWith(".cpp") && isOurs(file) && !isGenerated(file));
  for (const unit of ours) {
    unit.command = unit.command.replace(/-Winvalid-pch|-include \S+cmake_pch\.hxx/g, "");
    unit.command = unit.command.replace(/ -o \S+/, "");
  }
  return [...new Map(ours.map((unit) => [unit.file, unit])).values()];
}

/** The files as one text. What an earlier one includes is left out of a later one. */
function joined(files) {
  const included = new Set();
  return files.map((file) => {
    const own = new Set();
    const lines = content(file).toString().replace(/\n$/, "").split("\n");
    const kept = lines.map((line) => {
      if (!line.startsWith("#include") || own.has(line)) return line;
      own.add(line);
      return included.has(line) ? "" : line;
    });
    for (const line of own) included.add(line);
    return kept.join("\n") + "\n";
  }).join("");
}

/**
 * What clang-tidy runs over: a file, or some that have command, checks and configuration in common.
 * Files that name a header without its folder stay in theirs.
 */
function units() {
  const singles = [];
  const alike = new Map();
  for (const unit of commandsOfSources()) {
    const kind = isTest(unit.file) ? "test" : isProduct(unit.file) ? "product" : "other";
    const text = content(unit.file).toString();
    const folder = /^#include "[^/"]+"/m.test(text) ? dirname(unit.file) : "";
    const key = `${kind} ${folder} ${unit.command.replaceAll(unit.file, "")}`;
    const isAlone = /^int main\(/m.test(text);
    if (isAlone) singles.push(unitOf([unit]));
    else alike.set(key, [...(alike.get(key) ?? []), unit]);
  }
  const groups = [...alike.values()].flatMap((members) => {
    const commands = new Map(members.map((unit) => [unit.file, unit]));
    const options = { largest: largestGroup, mayRetry: true };
    return groupsOf([...commands.keys()], options).map((files) => files.map((file) => commands.get(file)));
  });
  return [...singles, ...groups.map((group) => unitOf(group.reverse()))];
}

/** `parts` are the commands of the files that a unit is made of. */
function unitOf(parts) {
  const [first] = parts;
  if (parts.length === 1) return { ...first, parts };
  const folder = dirname(first.file);
  const file = join(texts, isTest(first.file) ? "tests" : "", relative(root, first.file).replaceAll(sep, "_"));
  writeFileSync(file, joined(parts.map((part) => part.file)));
  const command = first.command.replaceAll(first.file, file).replace(" -c ", ` -iquote ${folder} -c `);
  return { ...first, file, command, parts };
}

/** The .clang-tidy files that hold for a source file. */
function configurations(file) {
  const found = [];
  for (let folder = dirname(file); folder.length >= root.length; folder = dirname(folder)) {
    if (existsSync(join(folder, ".clang-tidy"))) found.push(join(folder, ".clang-tidy"));
  }
  return found;
}

const version = execFileSync(tidy, ["--version"], { encoding: "utf8" });
const contents = new Map();
function content(path) {
  if (!contents.has(path)) contents.set(path, readFileSync(path));
  return contents.get(path);
}

/**
 * The path analysis takes most of the time: only the product's own code gets it, and it stays inside
 * of each function, or in its shallow mode.
 */
function checks({ parts }) {
  // One file's alias may be another one's header's: only the build tells what is hidden.
  const words = parts.length > 1 ? ["-Wno-shadow"] : [];
  if (isProduct(parts[0].file)) words.push("-Xclang", "-analyzer-config", "-Xclang", analysis);
  const options = words.map((word) => `--extra-arg=${word}`);
  return isProduct(parts[0].file) ? options : ["--checks=-clang-analyzer-*", ...options];
}

function stampOf(unit) {
  const hash = createHash("sha256").update(version).update(unit.command);
  hash.update(checks(unit).join());
  const files = unit.parts.map((part) => part.file);
  const sources = new Set(files);
  for (const file of files) for (const path of sourcesOf(file)) sources.add(path);
  for (const path of [...sources, ...configurations(files[0])].sort()) {
    hash.update(`\0${relative(root, path)}\0`).update(content(path));
  }
  return join(stamps, hash.digest("hex"));
}

/** What clang-tidy says of a unit; nothing if all is well. */
function findingsIn(unit) {
  const options = { cwd: root, maxBuffer: 2 ** 28 };
  return new Promise((done) => {
    execFile(tidy, [...checks(unit), "-p", stamps, "--quiet", unit.file], options, (error, out, err) => {
      const findings = `${relative(root, unit.file)}:\n${out}${out.trim() ? "" : err}`;
      done(error ? findings : "");
    });
  });
}

async function lint(unit) {
  const findings = await findingsIn(unit);
  if (!findings || unit.parts.length === 1) return findings;
  console.log(`         one by one, since together they do not pass: ${unit.parts.length} files`);
  const ofParts = [];
  for (const part of unit.parts) ofParts.push(await findingsIn(unitOf([part])));
  return ofParts.join("");
}

mkdirSync(join(texts, "tests"), { recursive: true });
copyFileSync(join(root, "tests", ".clang-tidy"), join(texts, "tests", ".clang-tidy"));
configure();
const known = new Set(readdirSync(stamps));
const commands = units();
const entries = commands.flatMap((unit) => (unit.parts.length > 1 ? [unit, ...unit.parts] : [unit]));
const database = entries.map(({ directory, command, file }) => ({ directory, command, file }));
writeFileSync(join(stamps, "compile_commands.json"), JSON.stringify(database));
const all = commands.map((unit) => ({ ...unit, stamp: stampOf(unit) }));
// The longest first: no core waits at the end.
const size = (unit) => unit.parts.reduce((sum, { file }) => sum + sourcesOf(file).size, 0);
const isOption = (word) => word.startsWith("--");
const wanted = process.argv.slice(2).filter((word) => !isOption(word)).map((file) => resolve(file));
const isWanted = ({ parts }) =>
  wanted.length === 0 || parts.some(({ file }) => wanted.includes(file));
const isNew = (unit) => !known.has(relative(stamps, unit.stamp));
const queue = all.filter((unit) => isWanted(unit) && isNew(unit));
queue.sort((one, other) => size(other) - size(one));
const filesOf = (list) => list.reduce((sum, unit) => sum + unit.parts.length, 0);
const linted = filesOf(queue);
let failures = 0;

async function work() {
  for (let unit = queue.shift(); unit; unit = queue.shift()) {
    const start = Date.now();
    const findings = await lint(unit);
    const seconds = ((Date.now() - start) / 1000).toFixed(1);
    const names = unit.parts.map(({ file }) => relative(root, file)).join(" ");
    console.log(`${seconds.padStart(6)} s  ${names}`);
    if (findings) {
      ++failures;
      console.log(findings);
    } else {
      writeFileSync(unit.stamp, names);
    }
  }
}

await Promise.all(cpus().map(work));
console.log(`${filesOf(all)} files, ${linted} checked, ${failures} with findings`);
process.exitCode = failures > 0 ? 1 : 0;
