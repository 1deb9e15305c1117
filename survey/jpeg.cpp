// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/internal/jpeg.h"

#include <fmt/format.h>

// libjpeg's headers need these two first.
#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <new>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco::internal {
namespace {

using namespace std::string_view_literals;

constexpr size_t kSniffedBytes = 512;

// A picture of one colour takes about 340 pixels a byte; a file that claims far more is damaged or
// made to exhaust memory.
constexpr uint64_t kMaxPixelsPerByte = 5000;

// Warnings that say nothing about the pixels; `in_pixels` while rows are still to come.
bool IsHarmless(int code, bool in_pixels) {
  switch (code) {
    case JWRN_ADOBE_XFORM:
    case JWRN_JFIF_MAJOR:
    case JWRN_BOGUS_ICC:
      return true;
    case JWRN_EXTRANEOUS_DATA:  // padding between header segments, or before the end (DJI)
      return !in_pixels;
    default:
      return false;
  }
}

// libjpeg's decompressor, closed in any case. libjpeg reports errors by a callback that must not
// return; it jumps back into Run.
class Decoder {
 public:
  explicit Decoder(const std::string& name) : name_(name) {
    info_.err = jpeg_std_error(&errors_);
    errors_.error_exit = OnError;
    errors_.emit_message = OnMessage;
    info_.client_data = this;
    Run([this] { jpeg_create_decompress(&info_); });
  }
  ~Decoder() { jpeg_destroy_decompress(&info_); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  // Calls `step`, which must hold nothing with a destructor: an error jumps out of it.
  template <typename Step>
  void Run(const Step& step) {
    if (setjmp(jump_) == 0) {
      step();
    } else {
      throw Error(ErrorKind::kBadInput, fmt::format("{}: damaged JPEG: {}", name_, message_.data()),
                  "copy the photo from the camera again, or remove it");
    }
  }

  jpeg_decompress_struct& info() { return info_; }
  void BeginPixels() { pixels_begun_ = true; }

 private:
  static void OnError(j_common_ptr info) {
    auto* decoder = static_cast<Decoder*>(info->client_data);
    info->err->format_message(info, decoder->message_.data());
    std::longjmp(decoder->jump_, 1);
  }

  static void OnMessage(j_common_ptr info, int level) {
    if (level >= 0) return;  // trace output
    const auto* decoder = static_cast<Decoder*>(info->client_data);
    if (!IsHarmless(info->err->msg_code, decoder->InPixels())) OnError(info);
  }

  bool InPixels() const { return pixels_begun_ && info_.output_scanline < info_.output_height; }

  const std::string& name_;
  jpeg_decompress_struct info_{};
  jpeg_error_mgr errors_{};
  std::jmp_buf jump_{};
  std::array<char, JMSG_LENGTH_MAX> message_{};
  bool pixels_begun_ = false;
};

void CheckIsJpeg(std::string_view bytes, const std::string& name) {
  if (LooksLikeJpeg(bytes)) return;
  throw Error(ErrorKind::kBadInput, fmt::format("{}: not a JPEG but {}", name, Describe(bytes)),
              bytes.empty() ? "copy the photo from the camera again, or remove it"
                            : "convert it to JPEG with its metadata, or remove it");
}

// The largest of libjpeg's fast reductions that leaves at least the wished size.
unsigned ReductionFor(ImageSize full, ImageSize wished) {
  for (const int divisor : {8, 4, 2}) {
    if ((full.width_px + divisor - 1) / divisor >= wished.width_px &&
        (full.height_px + divisor - 1) / divisor >= wished.height_px) {
      return static_cast<unsigned>(divisor);
    }
  }
  return 1;
}

void ReadRows(Decoder& decoder, Image& image) {
  jpeg_decompress_struct& info = decoder.info();
  const size_t stride = size_t{info.output_width} * info.output_components;
  uint8_t* const first = image.data.data();
  decoder.Run([&] {
    while (info.output_scanline < info.output_height) {
      JSAMPROW row = first + info.output_scanline * stride;
      jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
  });
}

Image Shrink(Image image, ImageSize wished) {
  if (image.width_px == wished.width_px && image.height_px == wished.height_px) return image;
  Image small{wished.width_px, wished.height_px, image.channels, {}};
  small.data.resize(size_t{1} * wished.width_px * wished.height_px * image.channels);
  const cv::Mat from(image.height_px, image.width_px, CV_8UC(image.channels), image.data.data());
  cv::Mat to(small.height_px, small.width_px, CV_8UC(small.channels), small.data.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

bool LooksLikeJpeg(std::string_view bytes) {
  return bytes.starts_with("\xff\xd8");
}

std::string Describe(std::string_view bytes) {
  bytes = bytes.substr(0, kSniffedBytes);
  if (bytes.empty()) return "empty";
  if (bytes.starts_with("\x89PNG")) return "a PNG picture";
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) {
    return "a TIFF or raw (DNG) picture";
  }
  if (bytes.starts_with("GIF8")) return "a GIF picture";
  if (bytes.starts_with("BM")) return "a BMP picture";
  if (bytes.starts_with("RIFF") && bytes.substr(8).starts_with("WEBP")) return "a WebP picture";
  if (bytes.substr(std::min<size_t>(4, bytes.size())).starts_with("ftyp")) {
    const std::string_view brand = bytes.substr(8, 4);
    if (brand == "avif") return "an AVIF picture";
    const bool is_heif = brand.starts_with("hei") || brand.starts_with("hev") || brand == "mif1";
    return is_heif ? "an HEIC picture" : "a video";
  }
  if (bytes.starts_with("%PDF")) return "a PDF document";
  if (bytes.starts_with("PK\x03\x04")) return "a ZIP archive";
  if (bytes.find_first_not_of('\0') == std::string_view::npos) return "zeros";
  const auto is_text = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte >= 0x20 && byte < 0xf8) || (c >= '\t' && c <= '\r');  // UTF-8 ends at 0xf7
  };
  return std::ranges::all_of(bytes, is_text) ? "text" : "data of an unknown kind";
}

Image DecodeJpeg(std::string_view bytes, const std::string& name, int channels, int max_side_px) {
  CheckIsJpeg(bytes, name);
  Decoder decoder(name);
  jpeg_decompress_struct& info = decoder.info();
  decoder.Run([&] {
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&info, TRUE);
  });
  decoder.BeginPixels();
  if (uint64_t{info.image_width} * info.image_height > kMaxPixelsPerByte * bytes.size()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: damaged JPEG: {} bytes cannot hold {} x {} pixels", name,
                            bytes.size(), info.image_width, info.image_height));
  }
  const ImageSize full = {static_cast<int>(info.image_width), static_cast<int>(info.image_height)};
  const ImageSize wished = ScaledSize(full, max_side_px);
  if (channels == 0) channels = info.num_components == 1 ? 1 : 3;
  info.out_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  info.scale_num = 1;
  info.scale_denom = ReductionFor(full, wished);
  info.dct_method = JDCT_ISLOW;  // the same bits with and without SIMD
  decoder.Run([&] { jpeg_start_decompress(&info); });

  Image image{
      static_cast<int>(info.output_width), static_cast<int>(info.output_height), channels, {}};
  try {
    image.data.resize(size_t{info.output_width} * info.output_height * info.output_components);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::kOutOfResource, fmt::format("{}: no memory for {} x {} pixels", name,
                                                       full.width_px, full.height_px));
  }
  ReadRows(decoder, image);
  return Shrink(std::move(image), wished);
}

ImageSize JpegSizeOf(const std::filesystem::path& path) {
  const std::string name = path.string();
  // Not ReadFile: the size is in the first kilobytes of many megabytes.
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  std::array<char, kSniffedBytes> start{};
  const size_t count = file ? std::fread(start.data(), 1, start.size(), file.get()) : 0;
  if (!file || std::ferror(file.get()) != 0) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: cannot be read: {}", name,
                                                  std::generic_category().message(errno)));
  }
  CheckIsJpeg({start.data(), count}, name);
  std::rewind(file.get());
  Decoder decoder(name);
  decoder.Run([&] {
    jpeg_stdio_src(&decoder.info(), file.get());
    jpeg_read_header(&decoder.info(), TRUE);
  });
  return {static_cast<int>(decoder.info().image_width),
          static_cast<int>(decoder.info().image_height)};
}

}  // namespace stucco::internal
