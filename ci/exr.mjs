// OpenEXR files for scripts that make maps.
import { closeSync, openSync, writeSync } from "node:fs";

function textBytes(text) {
  return Buffer.from(`${text}\0`);
}

function attribute(name, type, value) {
  const size = Buffer.alloc(4);
  size.writeInt32LE(value.length);
  return Buffer.concat([textBytes(name), textBytes(type), size, value]);
}

const int32 = (...values) => Buffer.from(Int32Array.from(values).buffer);
const float32 = (...values) => Buffer.from(Float32Array.from(values).buffer);

/** What stands before the scanlines of a file without compression: header and offsets. */
function beginning([w, h]) {
  const channels = ["B", "G", "R"].map((name) =>
    Buffer.concat([textBytes(name), int32(2), Buffer.alloc(4), int32(1, 1)]));
  const window = int32(0, 0, w - 1, h - 1);
  const header = Buffer.concat([
    int32(20000630, 2),
    attribute("channels", "chlist", Buffer.concat([...channels, Buffer.alloc(1)])),
    attribute("compression", "compression", Buffer.alloc(1)),
    attribute("dataWindow", "box2i", window),
    attribute("displayWindow", "box2i", window),
    attribute("lineOrder", "lineOrder", Buffer.alloc(1)),
    attribute("pixelAspectRatio", "float", float32(1)),
    attribute("screenWindowCenter", "v2f", float32(0, 0)),
    attribute("screenWindowWidth", "float", float32(1)),
    Buffer.alloc(1),
  ]);
  const chunk = 8 + 12 * w;
  const offsets = Buffer.alloc(8 * h);
  for (let y = 0; y < h; ++y) {
    offsets.writeBigInt64LE(BigInt(header.length + 8 * h + y * chunk), 8 * y);
  }
  return Buffer.concat([header, offsets]);
}

/** An OpenEXR file of 32-bit floats, uncompressed: channels B, G, R, a scanline a chunk. `rgb(x, y)` is
 * the pixel, y from the top. */
export function exr([w, h], rgb) {
  const chunks = [beginning([w, h])];
  for (let y = 0; y < h; ++y) {
    const rows = [2, 1, 0].map((c) => float32(...Array.from({ length: w }, (_, x) => rgb(x, y)[c])));
    chunks.push(int32(y, 12 * w), ...rows);
  }
  return Buffer.concat(chunks);
}

/** The same, written line by line, for files that are larger than memory should be: `row(y)` has the
 * values of blue, green and red, a Float32Array of w each. */
export function writeLargeExr(file, [w, h], row) {
  const descriptor = openSync(file, "w");
  writeSync(descriptor, beginning([w, h]));
  for (let y = 0; y < h; ++y) {
    const colours = row(y).map((values) => Buffer.from(values.buffer));
    writeSync(descriptor, Buffer.concat([int32(y, 12 * w), ...colours]));
  }
  closeSync(descriptor);
}
