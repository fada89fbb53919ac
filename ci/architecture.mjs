// What ci/architecture does. Usage: architecture.mjs [--check] [ROOT]
import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";

const check = process.argv.includes("--check");
const root = process.argv.slice(2).find((argument) => !argument.startsWith("--")) ?? ".";
const page = join(root, "docs", "architecture.md");

const text = (path) => readFileSync(join(root, path), "utf8");

/** The paragraph at the head of a CMakeLists.txt. */
function paragraphOf(cmake) {
  const lines = cmake.split("\n");
  const end = lines.findIndex((line) => !line.startsWith("#"));
  return lines.slice(0, end).map((line) => line.replace(/^#\s?/, "")).join(" ").trim();
}

/** The folders that a target links to, by the keyword that stands before them. */
function linksOf(cmake) {
  const links = { PUBLIC: [], PRIVATE: [] };
  const calls = cmake.match(/(lightproof_module|target_link_libraries)\([^)]*\)/g) ?? [];
  for (const call of calls) {
    let keyword = "";
    for (const word of call.split(/[\s()]+/)) {
      if (["PUBLIC", "PRIVATE", "SOURCES"].includes(word)) keyword = word;
      const folder = word.match(/^lightproof::(\w+)$/);
      if (folder && keyword in links) links[keyword].push(folder[1]);
    }
  }
  return links;
}

/** Every folder with its path, its paragraph, its links and, by folder, the files that include it. */
function readFolders() {
  const paths = readdirSync(join(root, "src/lightproof"), { withFileTypes: true })
    .filter((entry) => entry.isDirectory())
    .filter((entry) => readdirSync(join(root, "src/lightproof", entry.name)).length > 0)
    .map((entry) => `src/lightproof/${entry.name}`);
  const folders = new Map();
  for (const path of [...paths, "reference"]) {
    const cmake = text(`${path}/CMakeLists.txt`);
    const name = basename(path);
    const includes = new Map();
    for (const file of readdirSync(join(root, path)).filter((f) => /\.(h|cpp|in)$/.test(f))) {
      for (const [, folder] of text(`${path}/${file}`).matchAll(/#include "(?:lightproof\/)?(\w+)\//g)) {
        if (folder === name) continue;
        if (!includes.has(folder)) includes.set(folder, []);
        includes.get(folder).push(file);
      }
    }
    folders.set(name, { path, paragraph: paragraphOf(cmake), links: linksOf(cmake), includes, isProgram: /^add_executable\(/m.test(cmake) });
  }
  return folders;
}

/** What is wrong with the arrows, one sentence each. */
function faultsOf(folders) {
  const faults = [];
  for (const [name, { path, paragraph, links, includes, isProgram }] of folders) {
    const declared = [...links.PUBLIC, ...links.PRIVATE];
    if (!paragraph) faults.push(`${path}/CMakeLists.txt does not begin with what lives in ${name}`);
    for (const [folder, files] of includes) {
      const header = files.find((file) => file.endsWith(".h"));
      if (!folders.has(folder)) faults.push(`${path}/${files[0]} includes ${folder}/, which is no folder of this project`);
      else if (!declared.includes(folder)) faults.push(`${path}/${files[0]} includes ${folder}/, which ${path}/CMakeLists.txt does not link to`);
      else if (header && links.PRIVATE.includes(folder) && !isProgram) faults.push(`${path}/${header} includes ${folder}/, which ${path}/CMakeLists.txt links to PRIVATE`);
    }
    for (const folder of declared) {
      if (!includes.has(folder)) faults.push(`${path}/CMakeLists.txt links to ${folder}, which no file of ${name} includes`);
    }
  }
  return [...faults, ...privateHeadersOf(folders), ...clashesOf(folders), ...circlesOf(folders)];
}

/** Whether cmake/Install.cmake leaves a header out: it says at its head that it is private, or holds a kernel. */
const isPrivate = (path) =>
  path.endsWith("-inl.h") || text(path).split("#pragma once")[0].replaceAll("\n// ", " ").includes("Private to ");

/** Headers that are installed and include one that is not. */
function privateHeadersOf(folders) {
  const faults = [];
  for (const { path, isProgram } of folders.values()) {
    for (const file of readdirSync(join(root, path)).filter((f) => f.endsWith(".h"))) {
      if (isProgram || isPrivate(`${path}/${file}`)) continue;
      for (const [, included] of text(`${path}/${file}`).matchAll(/#include "(lightproof\/\w+\/[\w-]+\.h)"/g)) {
        if (existsSync(join(root, "src", included)) && isPrivate(`src/${included}`)) faults.push(`${path}/${file}, which is installed, includes ${included}, which is private`);
      }
    }
  }
  return faults;
}

/**
 * Types of one name and namespace in two headers: who includes both gets an error, and who does not,
 * templates over one that the linker takes for those over the other. (Highway's kernels have a
 * namespace for each file.)
 */
function clashesOf(folders) {
  const declared = new Map();
  for (const { path } of folders.values()) {
    for (const file of readdirSync(join(root, path)).filter((f) => f.endsWith(".h") && !f.endsWith("-inl.h"))) {
      const code = text(`${path}/${file}`);
      const space = code.match(/^namespace (\S+) \{/m)?.[1] ?? "";
      for (const [, name] of code.matchAll(/^(?:struct|class|enum class|concept|using)(?: alignas\(.*?\))? (\w+)\b(?!;|::)/gm)) {
        const type = `${space}::${name}`;
        declared.set(type, (declared.get(type) ?? new Set()).add(`${path}/${file}`));
      }
    }
  }
  return [...declared]
    .filter(([, files]) => files.size > 1)
    .map(([type, files]) => `${type} is declared in ${[...files].join(" and ")}`);
}

function circlesOf(folders) {
  const circles = [];
  const done = new Set();
  const visit = (name, way) => {
    if (way.includes(name)) {
      circles.push(`a circle: ${[...way.slice(way.indexOf(name)), name].join(" -> ")}`);
      return;
    }
    if (done.has(name)) return;
    for (const next of standsOn(folders, name)) visit(next, [...way, name]);
    done.add(name);
  };
  for (const name of folders.keys()) visit(name, []);
  return circles;
}

const standsOn = (folders, name) =>
  [...(folders.get(name)?.includes.keys() ?? [])].filter((folder) => folders.has(folder)).sort();

/** All that a folder reaches. */
function reaches(folders, name, seen = new Set()) {
  for (const next of standsOn(folders, name)) {
    if (!seen.has(next)) reaches(folders, next, seen.add(next));
  }
  return seen;
}

/** The arrows that follow from no others. */
function arrowsOf(folders) {
  const arrows = [];
  for (const name of folders.keys()) {
    const all = standsOn(folders, name);
    for (const to of all) {
      if (!all.some((other) => other !== to && reaches(folders, other).has(to))) arrows.push([name, to]);
    }
  }
  return arrows;
}

/** From those that stand on nothing to those that stand on most. */
function inOrder(folders) {
  const height = (name) => Math.max(0, ...standsOn(folders, name).map((next) => 1 + height(next)));
  return [...folders.keys()].sort((a, b) => height(a) - height(b) || a.localeCompare(b));
}

function generated(folders) {
  const arrows = arrowsOf(folders).map(([from, to]) => `  ${from} --> ${to}`).sort();
  const drawing = ["```mermaid", "flowchart BT", ...arrows, "```"].join("\n");
  const paragraphs = inOrder(folders).map((name) => {
    const on = standsOn(folders, name);
    const sees = on.length ? `It includes ${on.map((folder) => `\`${folder}\``).join(", ")}.` : "It includes no other folder.";
    return `**\`${folders.get(name).path}\`** ${folders.get(name).paragraph} ${sees}`;
  });
  return `${drawing}\n\nArrows that follow from others are left out.\n\n${paragraphs.join("\n\n")}`;
}

const begin = "<!-- Written by ci/architecture: begin -->";
const end = "<!-- Written by ci/architecture: end -->";

function pageWith(content) {
  const now = existsSync(page) ? readFileSync(page, "utf8") : `${begin}\n${end}\n`;
  const [before, rest] = now.split(begin);
  if (!rest?.includes(end)) {
    console.error(`architecture: ${page} lacks the lines "${begin}" and "${end}"`);
    process.exit(2);
  }
  return `${before}${begin}\n\n${content}\n\n${end}${rest.split(end)[1]}`;
}

if (!existsSync(join(root, "src/lightproof"))) {
  console.error(`architecture: ${root} holds no src/lightproof`);
  process.exit(2);
}
const folders = readFolders();
const faults = faultsOf(folders);
if (faults.length === 0) {
  const wanted = pageWith(generated(folders));
  if (!check) writeFileSync(page, wanted);
  else if (!existsSync(page) || wanted !== readFileSync(page, "utf8")) faults.push("docs/architecture.md is not what ci/architecture writes: run it");
}
for (const fault of faults) console.error(`architecture: ${fault}`);
if (faults.length === 0) console.log(`architecture: ${folders.size} folders, ${arrowsOf(folders).length} arrows, all hold`);
process.exit(faults.length ? 1 : 0);
