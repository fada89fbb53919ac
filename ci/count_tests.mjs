// usage: count_tests.mjs CTEST_JUNIT GTEST_FOLDER
//
// How many tests passed, failed and were skipped. A program that CTest ran as one test and that left
// its own results in GTEST_FOLDER counts with the tests inside it.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { basename, join } from "node:path";

const [junit, folder] = process.argv.slice(2);
const count = { passed: 0, failed: 0, skipped: 0 };

const attribute = (tag, name) => tag.match(new RegExp(`\\b${name}="([^"]*)"`))?.[1];
/** The elements <testcase …>, each with what stands inside. */
function cases(text) {
  return text.match(/<testcase\b(?:[^>]*\/>|[\s\S]*?<\/testcase>)/g) ?? [];
}

const programs = new Set();
for (const file of existsSync(folder) ? readdirSync(folder) : []) {
  programs.add(basename(file, ".xml"));
  for (const test of cases(readFileSync(join(folder, file), "utf8"))) {
    if (test.includes("<failure")) ++count.failed;
    else if (attribute(test, "result") === "skipped") ++count.skipped;
    else if (attribute(test, "status") === "run") ++count.passed;
  }
}
for (const test of cases(readFileSync(junit, "utf8"))) {
  const status = attribute(test, "status");
  const whole = programs.has(attribute(test, "name"));
  if (status === "run") count.passed += whole ? 0 : 1;
  else if (status === "fail") count.failed += whole ? 0 : 1;
  else ++count.skipped;
}
const skipped = count.skipped > 0 ? `, ${count.skipped} skipped` : "";
console.log(`${count.passed} passed, ${count.failed} failed${skipped}`);
