// The documents as HTML; see ci/docs. Usage: node docs.mjs FOLDER
import { copyFileSync, existsSync, mkdirSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { anchorOf, anchorsOf, documents, linksOf, read } from "./markdown.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "..");
const MarkdownIt = createRequire(join(root, "web", "package.json"))("markdown-it");
const site = resolve(process.argv[2]);

const style = `
  :root { color-scheme: light dark; }
  body { font: 16px/1.55 system-ui, sans-serif; max-width: 52rem; margin: 0 auto; padding: 1rem; }
  nav { border-bottom: 1px solid #8886; padding-bottom: .5rem; }
  pre { background: #8882; padding: .7rem; overflow-x: auto; }
  code { font: 14px/1.45 ui-monospace, "DejaVu Sans Mono", monospace; }
  table { border-collapse: collapse; display: block; overflow-x: auto; }
  th, td { border: 1px solid #8886; padding: .25rem .5rem; text-align: left; vertical-align: top; }
  img { max-width: 100%; height: auto; background: #fff; }
`;

const isOutside = (target) => /^[a-z]+:/.test(target);

/** A link of a page, taken apart: the path below the root, and the name of the heading. */
function resolved(page, target) {
  const [path, anchor = ""] = target.split("#");
  return { path: path ? relative(root, resolve(root, dirname(page), path)) || "." : page, anchor };
}

/** Where a path of the repository stands in the site. */
function placeOf(path) {
  if (path === "README.md" || path === ".") return "index.html";
  const isFolder = statSync(join(root, path)).isDirectory();
  if (isFolder) return existsSync(join(root, path, "README.md")) ? join(path, "README.html") : join(path, "index.html");
  return path.replace(/\.md$/, ".html");
}

function faultsOfLinks(page) {
  return linksOf(read(root, page)).filter(({ target }) => !isOutside(target)).flatMap(({ line, target }) => {
    const { path, anchor } = resolved(page, target);
    if (path.startsWith("api/")) return [];
    if (path.startsWith("..") || !existsSync(join(root, path))) return [`${page}:${line}: there is no ${target}`];
    const isPage = path.endsWith(".md");
    if (anchor && (!isPage || !anchorsOf(read(root, path)).includes(anchor))) {
      return [`${page}:${line}: ${path} has no heading ${anchor}`];
    }
    return [];
  });
}

/** Copies what is linked to and is no page: files, and folders as a list of their files. */
function copyLinked(path) {
  const from = join(root, path);
  if (path.endsWith(".md") || path.startsWith("api/") || existsSync(join(from, "README.md"))) return;
  if (!statSync(from).isDirectory()) {
    mkdirSync(dirname(join(site, path)), { recursive: true });
    copyFileSync(from, join(site, path));
    return;
  }
  const names = readdirSync(from).filter((name) => statSync(join(from, name)).isFile());
  names.forEach((name) => copyLinked(join(path, name)));
  const list = names.map((name) => `<li><a href="${name}">${name}</a></li>`).join("\n");
  write(join(path, "index.html"), path, `<h1>${path}</h1>\n<ul>\n${list}\n</ul>`);
}

function write(place, title, html) {
  const up = relative(dirname(place), ".") || ".";
  mkdirSync(dirname(join(site, place)), { recursive: true });
  writeFileSync(join(site, place), `<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>${title}</title>
<style>${style}</style>
<nav><a href="${up}/index.html">Lightproof</a> · <a href="${up}/docs/README.html">Documents</a> ·
<a href="${up}/api/index.html">API</a></nav>
${html}
</html>
`);
}

function render(page) {
  const markdown = new MarkdownIt({ html: false });
  const place = placeOf(page);
  const adjusted = (target) => {
    if (isOutside(target)) return target;
    const { path, anchor } = resolved(page, target);
    const there = path.startsWith("api/") ? path : placeOf(path);
    return (relative(dirname(place), there) || basename(there)) + (anchor ? `#${anchor}` : "");
  };
  const tokens = markdown.parse(read(root, page).replace(/<!--[\s\S]*?-->/g, ""), {});
  let title = page;
  tokens.forEach((token, i) => {
    if (token.type === "heading_open") {
      const text = tokens[i + 1].content;
      token.attrSet("id", anchorOf(text));
      if (token.tag === "h1") title = text;
    }
    for (const child of token.children ?? []) {
      for (const name of ["href", "src"]) {
        const target = child.attrGet(name);
        if (target) child.attrSet(name, adjusted(decodeURI(target)));
      }
    }
  });
  write(place, markdown.utils.escapeHtml(title), markdown.renderer.render(tokens, markdown.options, {}));
}

const pages = documents(root);
const faults = pages.flatMap(faultsOfLinks);
faults.forEach((fault) => console.error(fault));
if (faults.length === 0) {
  for (const page of pages) {
    render(page);
    linksOf(read(root, page)).filter(({ target }) => !isOutside(target))
      .forEach(({ target }) => copyLinked(resolved(page, target).path));
  }
  console.log(`${pages.length} pages`);
}
process.exitCode = faults.length > 0 ? 1 : 0;
