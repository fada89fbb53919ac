// Which sources of a folder one compiler run can take together, one included after the other.
//
// Two files stay apart where a name that one of them declares outside of functions occurs in the
// other: there it would be defined twice, hidden or taken for another. So nobody has to keep names
// apart between files. As a program: node ci/unity.mjs FILE… prints a line for each file that goes
// with others: the number of its group and its path.
import { existsSync, readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "..");

/** More files save little, and keep a core busy at the end of a build while the other is idle. */
const largestGroup = 8;

/** Highway compiles a file several times, and the order of macros and includes tells. */
const standsAlone = /^#(define|undef)\b|^#include HWY|^using namespace|foreach_target/m;

/** GCC warns of a class with members of hidden types, unless they stand in the main file. */
const standsAloneForGcc = /^(struct|class) \w+::/m;

/** The code without comments, strings and characters; `hidden_end` ends what a file keeps to itself. */
function bare(text) {
  const skipped =
    /R"(\w*)\([\s\S]*?\)\1"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])'|\/\/[^\n]*|\/\*[\s\S]*?\*\//g;
  return text.replace(/^\} {2}\/\/ namespace$/gm, "} hidden_end").replace(skipped, " ");
}

/**
 * The names that declarations give which begin a line (the body of a namespace is not indented),
 * but for functions that other files may call: a header declares these. Whoever is wary takes every
 * name that might be one, so that no build fails.
 */
function declared(code, { isWary = false } = {}) {
  const names = new Set();
  const begins =
    /^namespace \{|^\} hidden_end|^(?!#|\}|namespace\b|(?:TYPED_)?TEST|INSTANTIATE)(?=[A-Za-z_[])[\s\S]*?[;{]/gm;
  let hidden = false;
  for (const [declaration] of code.matchAll(begins)) {
    if (/^namespace|^\}/.test(declaration)) hidden = declaration.startsWith("namespace");
    if (/^namespace|^\}|^using [\w:]+;/.test(declaration)) continue;
    let head = declaration;
    for (let inner = ""; inner !== head; head = head.replace(/<[^<>;]*>/g, " ")) inner = head;
    if (!hidden && /^[^=]*\(/.test(head)) continue;
    const found = [
      ...head.matchAll(/\b(?:using|struct|class|enum(?: class)?|union|concept)\s+(\w+)/g),
      ...head.matchAll(/\b(?!requires\b)([A-Za-z_]\w*)\s*(?:\(|=|\{|;|\[)/g),
    ];
    for (const [, name] of isWary ? found : found.slice(0, 1)) names.add(name);
  }
  return names;
}

/** A file and those of ours that it includes, directly or not. */
const includes = new Map();
export function sourcesOf(file, found = new Set()) {
  if (found.has(file)) return found;
  found.add(file);
  if (!includes.has(file)) {
    const code = readFileSync(file, "utf8");
    const names = [...code.matchAll(/^\s*#\s*include "(.+)"/gm)].map((match) => match[1]);
    const places = [dirname(file), join(root, "src"), root];
    const paths = names.map((name) => places.map((place) => join(place, name)).find(existsSync));
    includes.set(file, paths.filter((path) => path !== undefined));
  }
  for (const path of includes.get(file)) sourcesOf(path, found);
  return found;
}

const headersOf = (file) => [...sourcesOf(file)].filter((path) => path !== file);

/** What a header declares, functions too. */
const declaredByHeaders = new Map();
function declaredBy(header) {
  if (!declaredByHeaders.has(header)) {
    const code = `namespace {\n${bare(readFileSync(header, "utf8"))}`;
    declaredByHeaders.set(header, declared(code.replace(/\b(inline|constexpr) /g, "")));
  }
  return declaredByHeaders.get(header);
}

/**
 * The files in groups, in their order; a file that must be alone is a group of its own. Who takes
 * files one by one where a group fails may let names occur in another file if they are not declared
 * there or in its headers: nearly always that serves, and makes far larger groups.
 */
export function groupsOf(files, { largest = largestGroup, mayRetry = false } = {}) {
  const groups = [];
  for (const file of files) {
    const text = readFileSync(file, "utf8");
    const code = bare(text);
    const names = declared(code, { isWary: !mayRetry });
    const words = mayRetry
      ? new Set([names, ...headersOf(resolve(file)).map(declaredBy)].flatMap((set) => [...set]))
      : new Set(code.match(/\b[A-Za-z_]\w*/g));
    const source = { file, names, words };
    const occursIn = (one, other) => [...one.names].some((name) => other.words.has(name));
    const goesWith = (other) => !occursIn(source, other) && !occursIn(other, source);
    const fits = ({ alone, sources }) =>
      !alone && sources.length < largest && sources.every(goesWith);
    const alone = standsAlone.test(text) || (!mayRetry && standsAloneForGcc.test(text));
    const group = alone ? undefined : groups.find(fits);
    if (group) group.sources.push(source);
    else groups.push({ alone, sources: [source] });
  }
  return groups.map(({ sources }) => sources.map((source) => source.file));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  groupsOf(process.argv.slice(2)).forEach((files, number) => {
    if (files.length > 1) for (const file of files) console.log(`${number} ${file}`);
  });
}
