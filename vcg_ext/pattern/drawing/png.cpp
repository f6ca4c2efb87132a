// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/png.h"

#include <cstring>

#include <png.h>

#include "common/errors.h"

namespace dcharts {

std::vector<std::uint8_t> PngFile(const Picture& picture) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::uint8_t> file(size);
  if (png_image_write_to_memory(&image, file.data(), &size, 0, picture.rgb.data(), 0, nullptr) == 0)
    throw Error(std::string("The picture in the pattern could not be packed: ") + image.message + ".");
  file.resize(size);
  return file;
}

}  // namespace dcharts
