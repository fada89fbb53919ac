// Samples of an environment map that a fragment shader draws into a texture of floats.

const side = 1024; // of the texture: a million samples a pass

/** An offscreen WebGL2 context that can draw into float textures. Throws if there is none. */
export function makeContext() {
  const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
  if (!gl) throw new Error("this browser has no WebGL2");
  if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("no float textures to draw into");
  return gl;
}

/** What the driver calls itself. */
export function driverOf(gl) {
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  return gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
}

function compiled(gl, kind, source) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

function linked(gl, fragmentSource, defines) {
  const head = `#version 300 es\nprecision highp float;\nprecision highp int;\n${defines}`;
  // One triangle over the whole target.
  const vertexSource =
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }";
  const program = gl.createProgram();
  gl.attachShader(program, compiled(gl, gl.VERTEX_SHADER, head + vertexSource));
  gl.attachShader(program, compiled(gl, gl.FRAGMENT_SHADER, head + fragmentSource));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

/** A texture that is fetched texel by texel, as this unit. */
function bindTexture(gl, program, name, unit, [internal, format], width, height, values) {
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texStorage2D(gl.TEXTURE_2D, 1, internal, width, height);
  if (values) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, format, gl.FLOAT, values);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  if (program) gl.uniform1i(gl.getUniformLocation(program, name), unit);
}

/** Means of the luminances of rows, and of the map, summed in float as in a host program. */
function averagesOf({ width, height, rgb }) {
  const f = Math.fround;
  const [red, green, blue] = [0.2989, 0.5866, 0.1145].map(f);
  const rows = new Float32Array(height);
  let total = 0;
  for (let y = 0; y < height; ++y) {
    let sum = 0;
    for (let i = 3 * y * width; i < 3 * (y + 1) * width; i += 3) {
      const grey = f(f(f(red * rgb[i]) + f(green * rgb[i + 1])) + f(blue * rgb[i + 2]));
      sum = f(sum + grey);
    }
    rows[y] = f(sum / width);
    total = f(total + rows[y]);
  }
  return { rows, map: f(total / height) };
}

/**
 * A row of four floats for each two random numbers: s, t, the density per unit square, the texel.
 * `source` is linear_scan.glsl and draw.frag; `map` is {width, height, rgb} from the lowest row up.
 */
export function drawSamples(gl, source, map, random, defines = "") {
  const count = random.length / 2;
  const rows = Math.ceil(count / side);
  const program = linked(gl, source, defines);
  gl.useProgram(program);
  const averages = averagesOf(map);
  const padded = new Float32Array(2 * side * rows);
  padded.set(random);
  bindTexture(gl, program, "map", 0, [gl.RGB32F, gl.RGB], map.width, map.height, map.rgb);
  bindTexture(gl, program, "row_averages", 1, [gl.R32F, gl.RED], 1, map.height, averages.rows);
  bindTexture(gl, program, "random", 2, [gl.RG32F, gl.RG], side, rows, padded);
  gl.uniform1f(gl.getUniformLocation(program, "average"), averages.map);

  bindTexture(gl, null, "", 3, [gl.RGBA32F, gl.RGBA], side, rows, null);
  const target = gl.getParameter(gl.TEXTURE_BINDING_2D);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
  gl.viewport(0, 0, side, rows);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const samples = new Float32Array(4 * side * rows);
  gl.readPixels(0, 0, side, rows, gl.RGBA, gl.FLOAT, samples);
  if (gl.getError() !== gl.NO_ERROR) throw new Error("an error of WebGL");
  return samples.subarray(0, 4 * count);
}
