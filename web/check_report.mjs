// Opens a report in Chromium, without a network, at two widths, and looks for what a reader would
// stumble over. Usage: node check_report.mjs PATH_TO_HTML OUT_DIR [LEAST_SECTIONS]
// Saves full-page screenshots in OUT_DIR. Exit code 1 with a list if there is any problem.
import { existsSync, mkdirSync } from "node:fs";
import { resolve, join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const viewports = [
  { name: "wide", width: 1280, height: 900 },
  { name: "narrow", width: 400, height: 800 },
];
const chromiumArguments = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-dev-shm-usage",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--no-first-run",
];
const drawingTimeout = 120_000; // milliseconds
const longest = 300; // characters of a message that are repeated
const leastSections = Number(process.argv[4] ?? 7);

/** Runs inside the page: everything about it that can be judged from its elements. */
function inspect(leastSections) {
  const problems = [];
  const root = document.documentElement;
  if (root.scrollWidth > root.clientWidth) {
    problems.push(`the page is ${root.scrollWidth} px wide in a window of ${root.clientWidth} px`);
  }
  for (const image of document.images) {
    if (image.naturalWidth === 0) problems.push(`picture not decoded: ${image.alt}`);
    if (!image.alt) problems.push("picture without a text alternative");
    if (image.clientWidth < 20) problems.push(`picture too small to see: ${image.alt}`);
  }
  if (document.querySelectorAll("section, header").length < leastSections) {
    problems.push("sections are missing");
  }
  if (window.injected) problems.push("text of the study was run as code");
  return problems;
}

/** Runs inside the page: one chart. */
function inspectChart(figure) {
  /** Where marks may stand: in the figure, or in what it scrolls to. */
  function outlineOf(figure) {
    const { left, right } = figure.getBoundingClientRect();
    const drawing = figure.querySelector(".drawing");
    return { left, right: right + drawing.scrollWidth - drawing.clientWidth };
  }
  const name = `chart ${figure.id}`;
  if (figure.dataset.drawn !== "yes") return [`${name}: not drawn`];
  const svg = figure.querySelector(".drawing svg.marks");
  if (!svg) return [`${name}: no SVG`];
  const problems = [];
  const frame = svg.getBoundingClientRect();
  if (frame.width < 150 || frame.height < 100) problems.push(`${name}: ${frame.width}x${frame.height} px`);
  const shapes = svg.querySelectorAll(
    ".mark-symbol.role-mark path, .mark-line.role-mark path, .mark-rule.role-mark line, " +
    ".mark-rect.role-mark path");
  const visible = [...shapes].filter((shape) => {
    const box = shape.getBoundingClientRect();
    return box.width + box.height > 0.5;
  });
  if (visible.length === 0) problems.push(`${name}: no marks`);
  const outline = outlineOf(figure);
  for (const shape of visible) {
    const box = shape.getBoundingClientRect();
    if (box.right > outline.right + 2 || box.left < outline.left - 2) {
      problems.push(`${name}: a mark lies outside the figure`);
      break;
    }
  }
  // Not the undefined or NaN that a broken formula writes into a path.
  for (const path of svg.querySelectorAll("path")) {
    if (/NaN|undefined|Infinity/.test(path.getAttribute("d") ?? "")) {
      problems.push(`${name}: a path with coordinates that are not numbers`);
      break;
    }
  }
  const texts = [...svg.querySelectorAll("text")]
    .filter((text) => text.textContent.trim() && getComputedStyle(text).opacity !== "0")
    .map((text) => ({ text: text.textContent, box: text.getBoundingClientRect() }))
    .filter(({ box }) => box.width > 0);
  if (texts.length < 4) problems.push(`${name}: hardly any text (${texts.length} labels)`);
  for (const { text, box } of texts) {
    if (box.height < 8) problems.push(`${name}: text too small: ${text}`);
    if (box.left < outline.left - 2 || box.right > outline.right + 2) {
      problems.push(`${name}: text cut off: ${text}`);
    }
  }
  for (let i = 0; i < texts.length; ++i) {
    for (let k = i + 1; k < texts.length; ++k) {
      const [a, b] = [texts[i].box, texts[k].box];
      const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (across > 2 && down > 0.35 * Math.min(a.height, b.height)) {
        problems.push(`${name}: "${texts[i].text}" and "${texts[k].text}" overlap`);
      }
    }
  }
  return problems;
}

/** Chooses every entry of every list of a chart and looks at it each time. */
async function inspectChoices(page, figure) {
  const problems = [];
  const lists = await figure.$$("select");
  for (const list of lists) {
    const values = await list.$$eval("option", (options) => options.map((o) => o.value));
    for (const value of values) {
      await list.selectOption(value);
      await page.waitForTimeout(60);
      for (const problem of await figure.evaluate(inspectChart)) {
        problems.push(`${problem} (after choosing "${value}")`);
      }
    }
    await list.selectOption(values[0]);
  }
  return problems;
}

/** Opens the closed block that a chart stands in, and waits until it is drawn there. */
async function unfold(page, figure, problems) {
  await figure.evaluate((chart) => {
    const closed = chart.closest("details:not([open])");
    if (closed) closed.open = true;
  });
  await page
    .waitForFunction((chart) => chart.dataset.drawn, figure, { timeout: drawingTimeout })
    .catch(() => problems.push("a folded chart was not drawn in time"));
}

async function inspectPage(context, url, view, folder) {
  const problems = [];
  const page = await context.newPage();
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) {
      problems.push(`console ${message.type()}: ${message.text().slice(0, longest)}`);
    }
  });
  page.on("pageerror", (error) => problems.push(`uncaught: ${error.message.slice(0, longest)}`));
  page.on("dialog", (dialog) => {
    problems.push(`a dialog opened: ${dialog.message()}`);
    dialog.dismiss();
  });
  await page.route("**/*", (route) => {
    const address = route.request().url();
    if (/^(file|data|blob):/.test(address)) return route.continue();
    problems.push(`asked the network for ${address}`);
    return route.abort();
  });
  await page.goto(url, { waitUntil: "load", timeout: drawingTimeout });
  await page
    .waitForFunction(() => document.documentElement.dataset.charts === "done", null,
      { timeout: drawingTimeout })
    .catch(() => problems.push("the charts were not finished in time"));
  problems.push(...(await page.evaluate(inspect, leastSections)));
  await page.screenshot({ path: join(folder, `${view.name}.png`), fullPage: true });
  for (const figure of await page.$$("figure.chart")) {
    await unfold(page, figure, problems);
    problems.push(...(await figure.evaluate(inspectChart)));
    problems.push(...(await inspectChoices(page, figure)));
  }
  // Opened tables must not widen the page either.
  await page.$$eval("details", (all) => all.forEach((details) => { details.open = true; }));
  problems.push(...(await page.evaluate(inspect, leastSections)).map((p) => `${p} (with all tables open)`));
  const charts = await page.$$eval("figure.chart", (all) => all.length);
  const pictures = await page.evaluate(() => document.images.length);
  console.log(`${view.name}: ${charts} charts, ${pictures} pictures, ${problems.length} problems`);
  return problems.map((problem) => `${view.name} (${view.width} px): ${problem}`);
}

async function main(file, folder) {
  if (!file || !folder || !existsSync(file)) {
    console.error("usage: node check_report.mjs PATH_TO_HTML OUT_DIR (the file must exist)");
    return 2;
  }
  mkdirSync(folder, { recursive: true });
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: chromiumArguments,
  });
  const problems = [];
  try {
    for (const view of viewports) {
      const context = await browser.newContext({
        viewport: { width: view.width, height: view.height },
        offline: true,
      });
      problems.push(...(await inspectPage(context, pathToFileURL(resolve(file)).href, view, folder)));
      await context.close();
    }
  } finally {
    await browser.close();
  }
  const counts = new Map();
  for (const problem of problems) counts.set(problem, (counts.get(problem) ?? 0) + 1);
  for (const [problem, count] of counts) {
    console.error(`PROBLEM ${problem}${count > 1 ? ` (${count} times)` : ""}`);
  }
  return problems.length > 0 ? 1 : 0;
}

process.exitCode = await main(process.argv[2], process.argv[3]);
