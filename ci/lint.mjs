// clang-tidy over every source file that build/release compiles. A file that passed before is
// skipped while nothing that it is made of has changed: its own text, our headers, the compile
// command, .clang-tidy. Exit 1 if there are findings.
import { execFile, execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { dirname, join, relative, resolve, sep } from "node:path";
import { fileURLToPath } from "node:url";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "..");
const build = join(root, "build", "release");
const stamps = join(root, "build", "lint");
const tidy = "clang-tidy-22";

const isOurs = (path) => path.startsWith(root + sep);
const isGenerated = (path) => path.startsWith(join(root, "build") + sep);

/** One compile command per source file of the repository, without GCC's precompiled headers. */
function units() {
  const commands = JSON.parse(readFileSync(join(build, "compile_commands.json"), "utf8"));
  const ours = commands.filter(({ file }) => isOurs(file) && !isGenerated(file));
  for (const unit of ours) {
    unit.command = unit.command.replace(/-Winvalid-pch|-include \S+cmake_pch\.hxx/g, "");
  }
  return [...new Map(ours.map((unit) => [unit.file, unit])).values()];
}

/** Our files that each source file was compiled from, as Ninja recorded them. */
function dependencies() {
  const lists = new Map();
  const options = { encoding: "utf8", maxBuffer: 2 ** 30 };
  const text = execFileSync("ninja", ["-C", build, "-t", "deps"], options);
  for (const block of text.split("\n\n")) {
    const paths = block.split("\n").slice(1).map((line) => resolve(build, line.trim()));
    if (paths.length > 0) lists.set(paths[0], paths.filter(isOurs));
  }
  return lists;
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
 * The path analysis takes most of the time: only the product's own code gets it, and it follows
 * calls no deeper than its shallow mode does.
 */
function checks(file) {
  if (!file.startsWith(join(root, "src") + sep)) return ["--checks=-clang-analyzer-*"];
  const words = ["-Xclang", "-analyzer-config", "-Xclang", "mode=shallow"];
  return words.map((word) => `--extra-arg=${word}`);
}

function stamp(unit, sources) {
  const hash = createHash("sha256").update(version).update(unit.command);
  hash.update(checks(unit.file).join());
  for (const path of [...sources, ...configurations(unit.file)].sort()) {
    hash.update(`\0${relative(root, path)}\0`).update(content(path));
  }
  return join(stamps, hash.digest("hex"));
}

function lint({ file }) {
  const options = { cwd: root, maxBuffer: 2 ** 28 };
  return new Promise((done) => {
    execFile(tidy, [...checks(file), "-p", stamps, "--quiet", file], options, (error, out, err) => {
      done(error ? `${relative(root, file)}:\n${out}${out.trim() ? "" : err}` : "");
    });
  });
}

mkdirSync(stamps, { recursive: true });
const sources = dependencies();
const known = new Set(readdirSync(stamps));
const commands = units();
writeFileSync(join(stamps, "compile_commands.json"), JSON.stringify(commands));
const all = commands.map((unit) => ({
  ...unit,
  stamp: stamp(unit, sources.get(unit.file) ?? [unit.file]),
}));
const queue = all.filter((unit) => !known.has(relative(stamps, unit.stamp)));
const linted = queue.length;
let failures = 0;

async function work() {
  for (let unit = queue.shift(); unit; unit = queue.shift()) {
    const start = Date.now();
    const findings = await lint(unit);
    const seconds = ((Date.now() - start) / 1000).toFixed(1);
    console.log(`${seconds.padStart(6)} s  ${relative(root, unit.file)}`);
    if (findings) {
      ++failures;
      console.log(findings);
    } else {
      writeFileSync(unit.stamp, relative(root, unit.file));
    }
  }
}

await Promise.all(cpus().map(work));
console.log(`${all.length} files, ${linted} checked, ${failures} with findings`);
process.exitCode = failures > 0 ? 1 : 0;
