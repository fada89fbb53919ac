// Reads a KTX 2.0 file of 16-bit floats with ktx-parse and compares it with what was to be written.
// Usage: node check_ktx2.mjs NODE_MODULES FILE.ktx2 EXPECTED.json
// NODE_MODULES is the folder that holds ktx-parse. EXPECTED holds vkFormat, width, height, channels,
// primaries, keys (an object of strings) and levels: a list of levels, each a list of faces, each a
// flat list of numbers. Exit code 1, with the first difference on standard error, if there is one.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [modules, file, expectedFile] = process.argv.slice(2);
const parser = createRequire(join(modules, "here.js")).resolve("ktx-parse");
const { read, write } = await import(pathToFileURL(parser).href);
const bytes = readFileSync(file);
const expected = JSON.parse(readFileSync(expectedFile, "utf8"));

function same(found, wanted, what) {
  const [a, b] = [found, wanted].map((value) => JSON.stringify(value));
  if (a !== b) throw new Error(`${what}: ${a} found, ${b} expected`);
}

/** The value of a 16-bit float, by IEEE 754. */
function half(bits) {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 0x3ff;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return exponent === 0 ? sign * fraction * 2 ** -24 : sign * (1024 + fraction) * 2 ** (exponent - 25);
}

function checkHeader(container) {
  same(container.vkFormat, expected.vkFormat, "vkFormat");
  same(container.typeSize, 2, "typeSize");
  same(container.pixelWidth, expected.width, "pixelWidth");
  same(container.pixelHeight, expected.height, "pixelHeight");
  same(container.pixelDepth, 0, "pixelDepth");
  same(container.layerCount, 0, "layerCount");
  same(container.faceCount, expected.levels[0].length, "faceCount");
  same(container.levelCount, expected.levels.length, "levelCount");
  same(container.supercompressionScheme, 0, "supercompressionScheme");
  same(container.globalData, null, "global data");
}

/** Section 5 of the Khronos Data Format Specification: linear RGB of signed floats. */
function checkDescriptor(container) {
  const channel = [0, 1, 2, 15];
  const samples = channel.slice(0, expected.channels).map((id, i) => ({
    bitOffset: 16 * i,
    bitLength: 15,
    channelType: 0xc0 | id,
    samplePosition: [0, 0, 0, 0],
    sampleLower: 0xbf800000 | 0, // -1
    sampleUpper: 0x3f800000, // 1
  }));
  same(container.dataFormatDescriptor.length, 1, "descriptor blocks");
  same(container.dataFormatDescriptor[0], {
    vendorId: 0,
    descriptorType: 0,
    versionNumber: 2,
    colorModel: 1, // RGBSDA
    colorPrimaries: expected.primaries,
    transferFunction: 1, // linear
    flags: 0,
    texelBlockDimension: [0, 0, 0, 0],
    bytesPlane: [2 * expected.channels, 0, 0, 0, 0, 0, 0, 0],
    samples,
  }, "data format descriptor");
}

function checkTexels(container) {
  expected.levels.forEach((faces, level) => {
    const data = container.levels[level].levelData;
    same(container.levels[level].uncompressedByteLength, data.byteLength, `length of level ${level}`);
    const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    same(data.byteLength, 2 * faces.flat().length, `bytes of level ${level}`);
    faces.flat().forEach((wanted, i) => {
      const found = half(view.getUint16(2 * i, true));
      if (found !== wanted) throw new Error(`level ${level}, value ${i}: ${found} found, ${wanted} expected`);
    });
  });
}

/** What the specification asks of offsets, and ktx-parse does not: smallest level first, aligned. */
function checkOffsets() {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const alignment = Math.max(4, 2 * expected.channels);
  let end = bytes.byteLength;
  expected.levels.forEach((_, level) => {
    const offset = Number(view.getBigUint64(80 + 24 * level, true));
    const length = Number(view.getBigUint64(88 + 24 * level, true));
    same(offset % alignment, 0, `alignment of level ${level}`);
    const gap = end - offset - length;
    if (gap < 0 || gap >= alignment) throw new Error(`level ${level} ends ${gap} bytes before the next part`);
    end = offset;
  });
  const [begin, size] = [view.getUint32(56, true), view.getUint32(60, true)];
  const gap = end - begin - size;
  if (gap < 0 || gap >= alignment) throw new Error(`the keys end ${gap} bytes before the levels`);
}

/** Those that the format defines come as text, all others as bytes that end with a NUL. */
function textOf(value) {
  if (value === undefined || typeof value === "string") return value;
  same(value.at(-1), 0, "last byte of a key's value");
  return Buffer.from(value.subarray(0, -1)).toString("utf8");
}

function checkKeys(container) {
  const names = Object.keys(container.keyValue);
  same(names, [...names].sort(), "order of the keys");
  for (const [name, value] of Object.entries(expected.keys)) same(textOf(container.keyValue[name]), value, name);
}

try {
  const container = read(new Uint8Array(bytes));
  checkHeader(container);
  checkDescriptor(container);
  checkKeys(container);
  checkTexels(container);
  checkOffsets();
  // ktx-parse writes the same file.
  const again = Buffer.from(write(container, { keepWriter: true }));
  if (!again.equals(bytes)) throw new Error("ktx-parse would have written other bytes");
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
}
