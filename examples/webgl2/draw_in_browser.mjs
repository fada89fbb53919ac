// Opens the page in headless Chromium, and writes the samples that its shader draws as a dump.
// Usage: node draw_in_browser.mjs DUMP.f32 [--map FILE --size WxH] [--random FILE]
//        [--published] [--flip]
//        node draw_in_browser.mjs --serve PORT
//
//   npm install
//   node draw_in_browser.mjs samples.f32
//   lightproof check samples.f32 --map sun-sky --size 128x64
//
// A row of the dump is s, t, the density per unit square, and the texel, as floats; DUMP.f32.json
// says so. --map is a file of three floats a texel, row by row from the bottom; without, the map is
// `sun-sky`. --random is a file of floats, two a sample. --published draws as the lecture's
// shader does, --flip is a defect, to see it found. With --serve the page can be seen in any browser, at http://127.0.0.1:PORT/.
import { createCipheriv } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";
import { sunSky } from "../node/sun_sky.mjs";

// The files of the page, by the names under which it asks for them.
const files = {
  "/": ["index.html", "text/html"],
  "/gpu_sampler.js": ["gpu_sampler.js", "text/javascript"],
  "/draw.frag": ["draw.frag", "text/plain"],
  "/linear_scan.glsl": ["../glsl/linear_scan.glsl", "text/plain"],
  "/sun_sky.mjs": ["../node/sun_sky.mjs", "text/javascript"],
};

const chromiumArguments = [
  "--no-sandbox",
  "--disable-dev-shm-usage",
  "--disable-background-networking",
  "--no-first-run",
  "--use-angle=swiftshader", // computes on the processor: no graphics card is needed
  "--enable-unsafe-swiftshader",
];

/** Serves the page; resolves to its address. Port 0 is any that is free. */
function serve(port) {
  const server = createServer((request, response) => {
    const file = files[new URL(request.url, "http://localhost").pathname];
    if (!file) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": file[1] });
    return response.end(readFileSync(new URL(file[0], import.meta.url)));
  });
  return new Promise((resolve) => {
    server.listen(port, "127.0.0.1", () =>
      resolve({ server, address: `http://127.0.0.1:${server.address().port}/` }));
  });
}

const floatsOf = (buffer) =>
  new Float32Array(buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + (buffer.length & ~3)));

/** Multiples of 2^-24 in [0,1): AES in counter mode. */
function randomNumbers(count) {
  const zeros = Buffer.alloc(16);
  const bytes = createCipheriv("aes-128-ctr", zeros, zeros).update(Buffer.alloc(4 * count));
  return Float32Array.from({ length: count }, (_, i) => (bytes.readUInt32LE(4 * i) >>> 8) * 2 ** -24);
}

function mapOf(options) {
  const [width, height] = options.size.split("x").map(Number);
  if (!options.map) return sunSky(width, height);
  return { width, height, rgb: floatsOf(readFileSync(options.map)) };
}

/** Runs inside the page: its function `draw`, with numbers as text on either side. */
function drawInPage({ width, height, rgb, random, defines }) {
  const floats = (text) =>
    new Float32Array(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
  const samples = window.draw({ width, height, rgb: floats(rgb) }, floats(random), defines);
  const bytes = new Uint8Array(samples.buffer, samples.byteOffset, samples.byteLength);
  let text = "";
  for (let i = 0; i < bytes.length; i += 32768) {
    text += String.fromCharCode(...bytes.subarray(i, i + 32768));
  }
  return { driver: window.driver(), samples: btoa(text) };
}

async function samplesInBrowser(map, random, defines) {
  const { server, address } = await serve(0);
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: chromiumArguments,
  });
  try {
    const page = await browser.newPage();
    page.on("pageerror", (error) => console.error(`in the page: ${error.message}`));
    await page.goto(`${address}?wait`);
    await page.waitForFunction(() => document.documentElement.dataset.ready);
    const text = (floats) => Buffer.from(floats.buffer).toString("base64");
    const { width, height, rgb } = map;
    const drawn = await page.evaluate(drawInPage,
      { width, height, rgb: text(rgb), random: text(random), defines });
    return { driver: drawn.driver, samples: Buffer.from(drawn.samples, "base64") };
  } finally {
    await browser.close();
    server.close();
  }
}

const { values: options, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    map: { type: "string" },
    size: { type: "string", default: "128x64" },
    random: { type: "string" },
    published: { type: "boolean", default: false },
    flip: { type: "boolean", default: false },
    serve: { type: "string" },
  },
});
if (options.serve) {
  console.log((await serve(Number(options.serve))).address);
} else if (positionals.length === 1) {
  const random = options.random ? floatsOf(readFileSync(options.random)) : randomNumbers(2 << 20);
  const defines = (options.published ? "#define PUBLISHED\n" : "") + (options.flip ? "#define FLIPPED\n" : "");
  const drawn = await samplesInBrowser(mapOf(options), random, defines);
  console.log(drawn.driver);
  writeFileSync(positionals[0], drawn.samples);
  writeFileSync(`${positionals[0]}.json`, JSON.stringify(
    { columns: ["s", "t", "pdf", "-"], measure: "square", density: "A", luminance: "published" }) + "\n");
} else {
  console.error("usage: node draw_in_browser.mjs DUMP.f32 [--map FILE --size WxH] [--random FILE] [--published] [--flip]\n" +
    "       node draw_in_browser.mjs --serve PORT");
  process.exit(2);
}
