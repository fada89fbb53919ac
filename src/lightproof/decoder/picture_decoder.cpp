#include "lightproof/decoder/picture_decoder.h"

namespace lightproof {

std::unique_ptr<PictureDecoder> open_picture(ByteReader& bytes, const OpenRequest& request) {
  switch (request.format) {
    case PictureFormat::openexr:
      return open_exr(bytes, request.part);
    case PictureFormat::radiance:
      return open_radiance(bytes);
    case PictureFormat::png:
      return open_png(bytes);
    case PictureFormat::jpeg:
      break;
  }
  return open_jpeg(bytes);
}

}  // namespace lightproof
