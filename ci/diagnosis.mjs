// What ci/diagnosis does. Usage: diagnosis.mjs PROGRAM RESULT SEEDS SAMPLES MAP…
import { execFileSync, spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";

const [program, result, seeds, samples, ...maps] = process.argv.slice(2);
const kLeastRight = 0.9;
const kMostWrong = 0.02;

const options = { encoding: "utf8", maxBuffer: 2 ** 30 };
const list = JSON.parse(execFileSync(program, ["list", "mutants", "--json"], options)).entries;
const names = new Map(list.filter(({ over }) => over === "map").map((m) => [m.name, m.diagnosis]));
const records = new Map(
  [...names].map(([name, diagnosis]) => [name, { name, diagnosis, rejected: 0, right: 0, unknown: 0, wrong: {} }]));

/** The rejections of all mutants on one map. */
function rejections(map, seed) {
  const samplers = [...names.keys()].flatMap((name) => ["--sampler", name]);
  const words = ["gate", map, "--repair", ...samplers, "-n", samples, "--seed", String(seed), "--json", "-", "-q"];
  const { status, stdout, stderr } = spawnSync(program, words, options);
  if (status !== 0 && status !== 1) throw new Error(`${words.join(" ")}: ${status}\n${stderr}`);
  return JSON.parse(stdout).rejections;
}

for (let seed = 1; seed <= Number(seeds); ++seed) {
  for (const map of maps) {
    for (const { sampler, looks_like: name, density } of rejections(map, seed)) {
      const record = records.get(sampler);
      ++record.rejected;
      if (name === record.diagnosis) ++record.right;
      else if (name === "unknown") ++record.unknown;
      else {
        record.wrong[name] = (record.wrong[name] ?? 0) + 1;
        console.log(`${sampler} ${density} on ${map}, seed ${seed}: ${name} instead of ${record.diagnosis}`);
      }
    }
  }
}

const all = [...records.values()];
const sum = (key) => all.reduce((total, record) => total + record[key], 0);
const wrong = all.reduce((total, record) => total + Object.values(record.wrong).reduce((a, b) => a + b, 0), 0);
const rejected = sum("rejected");
for (const { name, diagnosis, right, unknown, rejected: of } of all) {
  if (right < kLeastRight * of) console.log(`${name} (${diagnosis}): ${right} of ${of} right, ${unknown} unknown`);
}
writeFileSync(result, JSON.stringify(all, null, 2));
const runs = 2 * names.size * maps.length * Number(seeds);
const percent = (count) => `${((100 * count) / rejected).toFixed(1)} %`;
console.log(`${runs} runs, ${rejected} rejected: ${percent(sum("right"))} by their right name, ` +
  `${percent(sum("unknown"))} unknown, ${percent(wrong)} by a wrong one`);
process.exit(rejected > 0 && sum("right") >= kLeastRight * rejected && wrong <= kMostWrong * rejected ? 0 : 1);
