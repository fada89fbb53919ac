// A sample a fragment, into a texture of floats: s, t, pdf, and y (W + 1) + x of the texel.
uniform highp sampler2D map;
uniform highp sampler2D row_averages;
uniform highp sampler2D random;
uniform float average;

out vec4 sampled;

void main() {
  vec2 u = texelFetch(random, ivec2(gl_FragCoord.xy), 0).rg;
  Drawn drawn = draw(map, row_averages, average, u);
  int columns = textureSize(map, 0).x + 1;
  sampled = vec4(drawn.at, drawn.pdf, float(drawn.texel.y * columns + drawn.texel.x));
}
