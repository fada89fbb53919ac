// A sample an invocation. The rows of `samples` are s, t, pdf, and y (W + 1) + x of the texel.
layout(local_size_x = 64) in;

uniform highp sampler2D map;
uniform highp sampler2D row_averages;
uniform float average;

layout(std430, binding = 0) readonly buffer Random { vec2 random[]; };
layout(std430, binding = 1) writeonly buffer Samples { vec4 samples[]; };

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= random.length()) return;
  Drawn drawn = draw(map, row_averages, average, random[i]);
  int columns = textureSize(map, 0).x + 1;
  samples[i] = vec4(drawn.at, drawn.pdf, float(drawn.texel.y * columns + drawn.texel.x));
}
