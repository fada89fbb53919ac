// The sampler of the lecture "Image-based Lighting", as published, for GLSL ES 3.0 and later: a sum
// over the averages of rows until it reaches the random number, then one over the luminances of
// that row. What the published shader leaves to the driver is left to it here, too: the quotient
// 0/0, sums that end below the random number, texels fetched beside the map, the rounding of
// divisions. The map holds radiance, so the published decoding of 8-bit texels (^2.2) is done.

/// The published weights of red, green and blue.
float luminance(vec3 rgb) { return dot(vec3(0.2989, 0.5866, 0.1145), rgb); }

/// A sample: its position, s from the left and t from row 0 of the map; its texel, which lies
/// beside the map where a scan ran off; its density per unit square.
struct Drawn {
  vec2 at;
  ivec2 texel;
  float pdf;
};

/// The sample of two random numbers in [0,1): u.y draws the row, u.x the column. Column 0 of
/// `row_averages` holds the mean luminance of each row, `average` is that of the map.
Drawn draw(highp sampler2D map, highp sampler2D row_averages, float average, vec2 u) {
  int height = textureSize(row_averages, 0).y;
  float row_average = 1.0;
  float sum = 0.0;
  float before = 0.0;
  int y = 0;
  while (y < height) {
    row_average = texelFetch(row_averages, ivec2(0, y), 0).r;
    sum += row_average / average / float(height);
    if (sum >= u.y) break;
    before = sum;
    ++y;
  }
  float t = (float(y) + (u.y - before) / (sum - before)) / float(height);

  int width = textureSize(map, 0).x;
  float grey = 0.0;
  sum = 0.0;
  before = 0.0;
  int x = 0;
  while (x < width) {
    grey = luminance(texelFetch(map, ivec2(x, y), 0).rgb);
    sum += grey / row_average / float(width);
    if (sum >= u.x) break;
    before = sum;
    ++x;
  }
  float s = (float(x) + (u.x - before) / (sum - before)) / float(width);

#ifdef HALF_TEXEL
  // A defect, to see it found: positions are counted from the centres of texels.
  s = fract(s + 0.5 / float(width));
#endif
#ifdef FLIPPED
  // A defect, to see it found: the rows of the map are counted from the other side.
  t = 1.0 - t;
#endif
  return Drawn(vec2(s, t), ivec2(x, y), grey / average);
}
