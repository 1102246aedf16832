#include <csetjmp>
#include <cstdint>
#include <cstdio>
// jpeglib.h wants cstdio before it.
#include <jpeglib.h>

#include "core/foundation/error.h"
#include "io/grey_picture_jpeg.h"

namespace adit::io {
namespace {

/// libjpeg's state, and where it goes back to when something is wrong: its C code knows no exceptions.
struct Decoder {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf refused{};
  char words[JMSG_LENGTH_MAX] = {};

  Decoder() {
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = [](j_common_ptr at) { refuse(at); };
    errors.emit_message = [](j_common_ptr at, int level) {
      if (level < 0) refuse(at);  // a warning: the bytes are not what they should be
    };
    jpeg.client_data = this;
  }
  ~Decoder() { jpeg_destroy_decompress(&jpeg); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

 private:
  [[noreturn]] static void refuse(j_common_ptr at) {
    auto* decoder = static_cast<Decoder*>(at->client_data);
    at->err->format_message(at, decoder->words);
    std::longjmp(decoder->refused, 1);
  }
};

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 30;  // as OpenCV takes of the other kinds

/// False where it is damaged, or says that it is larger than any camera's. Between setjmp and its end nothing may live
/// that has a destructor.
bool decode(Decoder& decoder, const std::string& bytes, GreyPicture& picture) {
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  if (setjmp(decoder.refused) != 0) return false;
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  if (std::uint64_t{jpeg.image_width} * jpeg.image_height > most_pixels) {
    std::snprintf(decoder.words, sizeof decoder.words, "%u x %u pixels", jpeg.image_width, jpeg.image_height);
    return false;
  }
  jpeg.out_color_space = JCS_GRAYSCALE;
  jpeg_start_decompress(&jpeg);
  picture = GreyPicture(static_cast<int>(jpeg.output_width), static_cast<int>(jpeg.output_height));
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = picture.pixels.data() + picture.index(0, static_cast<int>(jpeg.output_scanline));
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return true;
}

}  // namespace

bool is_jpeg(const std::string& bytes) {
  return bytes.rfind("\xFF\xD8", 0) == 0;
}

GreyPicture grey_of_jpeg(const std::string& bytes, const std::string& file) {
  Decoder decoder;
  GreyPicture picture;
  if (!decode(decoder, bytes, picture))
    throw Error(std::string("the JPEG is damaged or of a rare kind: ") + decoder.words, file,
                "copy it from the camera again; if it opens elsewhere, save it as PNG");
  return picture;
}

}  // namespace adit::io
