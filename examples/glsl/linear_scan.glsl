// The sampler of the lecture "Image-based Lighting", for GLSL ES 3.0 and later: a sum over the averages
// of rows until it reaches the random number, then one over the luminances of that row. The map
// holds radiance, so the published decoding of 8-bit texels (^2.2) is done.
//
// With PUBLISHED it is as published, and what that leaves to rounding and to the driver is left to
// them: the quotient 0/0, sums that end below the random number, texels fetched beside the map. Without,
// a scan stops at texels with light only, and at the last of them at the latest.

/// The published weights of red, green and blue.
float luminance(vec3 rgb) { return dot(vec3(0.2989, 0.5866, 0.1145), rgb); }

/// A sample: its position, s from the left and t from row 0 of the map; its texel, which lies
/// beside the map where a published scan ran off; its density per unit square.
struct Drawn {
  vec2 at;
  ivec2 texel;
  float pdf;
};

/// Where a scan stands: a cell, and the sums before and behind it.
struct Scan {
  int cell;
  float before;
  float sum;
};

/// Whether a scan ends at its cell.
bool reaches(Scan scan, float u) {
#ifdef PUBLISHED
  return scan.sum >= u;
#else
  return scan.sum >= u && scan.sum > scan.before;
#endif
}

/// A scan that has passed all cells; `lit` is the last one whose sum grew.
Scan ended(Scan scan, Scan lit) {
#ifdef PUBLISHED
  return scan;
#else
  return lit;
#endif
}

float position(Scan scan, float u, int cells) {
#ifndef PUBLISHED
  u = min(u, scan.sum);
#endif
  return (float(scan.cell) + (u - scan.before) / (scan.sum - scan.before)) / float(cells);
}

/// The sample of two random numbers in [0,1): u.y draws the row, u.x the column. Column 0 of
/// `row_averages` holds the mean luminance of each row, `average` is that of the map.
Drawn draw(highp sampler2D map, highp sampler2D row_averages, float average, vec2 u) {
  int height = textureSize(row_averages, 0).y;
  float row_average = 1.0;
  Scan rows = Scan(0, 0.0, 0.0);
  Scan lit = rows;
  while (rows.cell < height) {
    row_average = texelFetch(row_averages, ivec2(0, rows.cell), 0).r;
    rows.sum += row_average / average / float(height);
    if (reaches(rows, u.y)) break;
    if (rows.sum > rows.before) lit = rows;
    rows.before = rows.sum;
    ++rows.cell;
  }
  if (rows.cell == height) rows = ended(rows, lit);
#ifndef PUBLISHED
  row_average = texelFetch(row_averages, ivec2(0, rows.cell), 0).r;
#endif

  int width = textureSize(map, 0).x;
  float grey = 0.0;
  Scan columns = Scan(0, 0.0, 0.0);
  lit = columns;
  while (columns.cell < width) {
    grey = luminance(texelFetch(map, ivec2(columns.cell, rows.cell), 0).rgb);
    columns.sum += grey / row_average / float(width);
    if (reaches(columns, u.x)) break;
    if (columns.sum > columns.before) lit = columns;
    columns.before = columns.sum;
    ++columns.cell;
  }
  if (columns.cell == width) columns = ended(columns, lit);
#ifndef PUBLISHED
  grey = luminance(texelFetch(map, ivec2(columns.cell, rows.cell), 0).rgb);
#endif

  vec2 at = vec2(position(columns, u.x, width), position(rows, u.y, height));
#ifndef PUBLISHED
  at = min(at, vec2(0.99999994)); // the largest float below 1
#endif
#ifdef HALF_TEXEL
  // A defect, to see it found: positions are counted from the centres of texels.
  at.x = fract(at.x + 0.5 / float(width));
#endif
#ifdef FLIPPED
  // A defect, to see it found: the rows of the map are counted from the other side.
  at.y = 1.0 - at.y;
#endif
  return Drawn(at, ivec2(columns.cell, rows.cell), grey / average);
}
