// What ci/perf does with JSON. Usage:
//   perf.mjs count OUT REGEX PROGRAM [ARGUMENT…]   instructions of PROGRAM's benchmarks count/…, one
//                                                  process each, as a file for `history add`
//   perf.mjs adopt FROM FILE…                      machine, compiler and flags of FROM for files that
//                                                  lack them: programs that did not say so yet
//   perf.mjs suspects FILE                         names of suspected benchmarks, one a line
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const read = (file) => JSON.parse(readFileSync(file, "utf8"));
const write = (file, document) => writeFileSync(file, JSON.stringify(document, null, 1));
const quiet = { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] };
const literal = (text) => text.replace(/[.*+?^$(){}|[\]\\]/g, "\\$&");

function namesOf([program, ...words], filter) {
  try {
    const list = execFileSync(program, [...words, "--benchmark_list_tests"], quiet);
    return list.split("\n").filter((name) => name.startsWith("count/") && filter.test(name));
  } catch {
    return []; // Google Benchmark fails where no name fits
  }
}

/** One benchmark under callgrind: its entry, with the instructions of a sample, and the context. */
function countOf([program, ...words], name, folder) {
  const [result, profile] = [join(folder, "result.json"), join(folder, "profile")];
  execFileSync("valgrind", [
    "--tool=callgrind", "--toggle-collect=*counted_kernel*", `--callgrind-out-file=${profile}`,
    program, ...words, `--benchmark_filter=^${literal(name)}$`, `--benchmark_out=${result}`,
    "--benchmark_out_format=json",
  ], quiet);
  const total = Number(readFileSync(profile, "utf8").match(/^totals: (\d+)$/m)?.[1]);
  if (!(total > 0)) throw new Error(`${name}: no function counted_kernel was seen`);
  const { context, benchmarks: [entry] } = read(result);
  entry.run_name = entry.run_name.replace(/\/iterations:\d+/, "");
  entry.instructions = total / (entry.samples ?? 1);
  return { context, entry };
}

function count(out, regex, ...command) {
  const folder = mkdtempSync(join(tmpdir(), "lightproof-"));
  try {
    const filter = new RegExp(regex);
    const counts = namesOf(command, filter).map((name) => countOf(command, name, folder));
    if (counts.length === 0) return;
    write(out, { context: counts[0].context, benchmarks: counts.map(({ entry }) => entry) });
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function adopt(from, ...files) {
  const { context } = read(from);
  for (const file of files) {
    const document = read(file);
    for (const key of ["machine", "compiler", "flags"]) document.context[key] ??= context[key];
    write(file, document);
  }
}

function suspects(file) {
  const rows = read(file).rows.filter(({ verdict }) => verdict === "suspected");
  for (const { benchmark } of rows) console.log(benchmark);
}

const [command, ...words] = process.argv.slice(2);
({ count, adopt, suspects })[command](...words);
