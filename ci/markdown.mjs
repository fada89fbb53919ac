// What scripts read in the documents: their commands, words of code, headings and links.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

/** The documents, as paths below the root of the repository. */
export function documents(root) {
  const below = (folder) =>
    readdirSync(join(root, folder), { recursive: true })
      .filter((name) => name.endsWith(".md") && !name.includes("node_modules"))
      .map((name) => join(folder, name));
  return ["README.md", "CHANGELOG.md", ...below("docs"), ...below("examples")].sort();
}

/** The text as blocks: {fence, line, lines}; `fence` is the language, or null outside of fences. */
function blocksOf(text) {
  const blocks = [{ fence: null, line: 1, lines: [] }];
  text.split("\n").forEach((line, i) => {
    const current = blocks.at(-1);
    const mark = /^\s*```(\S*)/.exec(line);
    if (!mark) current.lines.push(line);
    else blocks.push({ fence: current.fence === null ? mark[1] : null, line: i + 2, lines: [] });
  });
  if (blocks.at(-1).fence !== null) throw new Error(`line ${blocks.at(-1).line}: a fence is not closed`);
  return blocks;
}

/** Command and comment of a line of shell: a # in quotes or inside of a word begins no comment. */
export function splitComment(line) {
  let quote = "";
  for (let i = 0; i < line.length; ++i) {
    const letter = line[i];
    if (quote) quote = letter === quote ? "" : quote;
    else if (letter === "'" || letter === '"') quote = letter;
    else if (letter === "#" && (i === 0 || /\s/.test(line[i - 1]))) {
      return { command: line.slice(0, i).trim(), comment: line.slice(i + 1).trim() };
    }
  }
  return { command: line.trim(), comment: "" };
}

/** The commands in blocks of `sh`: {line, command, comment}; a comment goes on in lines without a
 * command, a command after a backslash. */
export function commandsOf(text) {
  const commands = [];
  for (const block of blocksOf(text).filter(({ fence }) => fence === "sh")) {
    let unfinished = null;
    let previous = null;
    block.lines.forEach((line, i) => {
      const { command, comment } = splitComment(line);
      if (unfinished) {
        unfinished.command += ` ${command}`;
      } else if (command) {
        unfinished = { line: block.line + i, command, comment: "" };
      } else if (previous && comment) {
        previous.comment += ` ${comment}`;
      } else if (!comment) {
        previous = null;
      }
      if (!unfinished) return;
      unfinished.comment += comment;
      if (unfinished.command.endsWith("\\")) {
        unfinished.command = unfinished.command.slice(0, -1).trim();
      } else {
        commands.push(unfinished);
        previous = unfinished;
        unfinished = null;
      }
    });
  }
  return commands;
}

/** Words of code in prose: {line, code}. */
export function codeOf(text) {
  const found = [];
  for (const block of blocksOf(text).filter(({ fence }) => fence === null)) {
    const prose = block.lines.join("\n");
    for (const match of prose.matchAll(/`([^`]+)`/g)) {
      const line = block.line + prose.slice(0, match.index).split("\n").length - 1;
      found.push({ line, code: match[1].replace(/\s+/g, " ") });
    }
  }
  return found;
}

/** Targets of links and pictures in prose: {line, target}. */
export function linksOf(text) {
  const found = [];
  for (const block of blocksOf(text).filter(({ fence }) => fence === null)) {
    block.lines.forEach((line, i) => {
      for (const match of line.replace(/`[^`]*`/g, "").matchAll(/\]\(([^)\s]+)\)/g)) {
        found.push({ line: block.line + i, target: match[1] });
      }
    });
  }
  return found;
}

/** The name by which a heading is linked to, as GitHub makes it. */
export function anchorOf(heading) {
  return heading.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, "").trim().replace(/\s/g, "-");
}

/** Those names of all headings. */
export function anchorsOf(text) {
  return blocksOf(text).filter(({ fence }) => fence === null).flatMap(({ lines }) => lines)
    .filter((line) => /^#{1,6} /.test(line)).map((line) => anchorOf(line.replace(/^#+ /, "")));
}

export function read(root, page) {
  return readFileSync(join(root, page), "utf8");
}
