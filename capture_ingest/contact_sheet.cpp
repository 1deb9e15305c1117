// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/contact_sheet.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "capture_ingest/health.h"

namespace stucco {
namespace {

constexpr int kPerRow = 8;
constexpr int kMargin_px = 6;
constexpr int kCaption_px = 16;
constexpr int kCellWidth_px = kThumbnailWidth_px + 2 * kMargin_px;
constexpr int kCellHeight_px = kThumbnailHeight_px + kCaption_px + 2 * kMargin_px;
constexpr size_t kMostCells = 2400;  // 300 rows: 44 000 pixels, where JPEG ends at 65 535

const cv::Scalar kPaper(255, 255, 255);
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kMissing(225, 225, 225);
const cv::Scalar kRed(200, 30, 30);

// Of `count` things, `kept` spread evenly.
std::vector<size_t> EvenlySpread(size_t count, size_t kept) {
  std::vector<size_t> indices;
  for (size_t i = 0; i < kept; ++i) indices.push_back(i * count / kept);
  return indices;
}

std::vector<const PhotoRecord*> Chosen(std::span<const PhotoRecord> records) {
  std::vector<const PhotoRecord*> chosen;
  if (records.size() <= kMostCells) {
    for (const PhotoRecord& record : records) chosen.push_back(&record);
    return chosen;
  }
  std::vector<const PhotoRecord*> usable;
  for (const PhotoRecord& record : records) {
    auto& side = record.photo.usable ? usable : chosen;
    side.push_back(&record);
  }
  chosen.resize(std::min(chosen.size(), kMostCells));
  for (const size_t i :
       EvenlySpread(usable.size(), std::min(usable.size(), kMostCells - chosen.size()))) {
    chosen.push_back(usable[i]);
  }
  std::sort(chosen.begin(), chosen.end());  // all point into one span: the order of the records
  return chosen;
}

// The last characters that fit; OpenCV's font has ASCII only.
std::string Caption(const std::string& text, size_t most, bool keep_end) {
  std::string ascii;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) == 0x80) continue;  // the rest of a character that became '?'
    ascii += byte >= 0x20 && byte < 0x7f ? c : '?';
  }
  if (ascii.size() <= most) return ascii;
  return keep_end ? ".." + ascii.substr(ascii.size() - most + 2) : ascii.substr(0, most - 2) + "..";
}

void Write(cv::Mat& sheet, const std::string& text, cv::Point at, const cv::Scalar& color) {
  cv::putText(sheet, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.34, color, 1, cv::LINE_AA);
}

cv::Mat DecodedThumbnail(const PhotoRecord& record) {
  if (record.thumbnail.empty()) return {};
  const std::vector<uchar> bytes(record.thumbnail.begin(), record.thumbnail.end());
  cv::Mat bgr = cv::imdecode(bytes, cv::IMREAD_COLOR);
  if (!bgr.empty()) cv::cvtColor(bgr, bgr, cv::COLOR_BGR2RGB);
  return bgr;
}

void DrawCell(const PhotoRecord& record, cv::Point corner, cv::Mat& sheet) {
  const cv::Rect frame(corner.x + kMargin_px, corner.y + kMargin_px, kThumbnailWidth_px,
                       kThumbnailHeight_px);
  const cv::Mat thumbnail = DecodedThumbnail(record);
  if (thumbnail.empty()) {
    cv::rectangle(sheet, frame, kMissing, cv::FILLED);
  } else {
    const cv::Point inside(frame.x + (frame.width - thumbnail.cols) / 2,
                           frame.y + (frame.height - thumbnail.rows) / 2);
    thumbnail.copyTo(sheet(cv::Rect(inside, thumbnail.size())));
  }
  const cv::Scalar& color = record.photo.usable ? kInk : kRed;
  if (!record.photo.usable) {
    cv::rectangle(sheet, frame, kRed, 4);
    const cv::Rect band(frame.x, frame.y + frame.height - 16, frame.width, 16);
    cv::rectangle(sheet, band, kPaper, cv::FILLED);
    Write(sheet, Caption(record.photo.why, 26, /*keep_end=*/false),
          {frame.x + 5, frame.y + frame.height - 5}, kRed);
    cv::rectangle(sheet, frame, kRed, 4);
  }
  Write(sheet, Caption(record.photo.path, 26, /*keep_end=*/true),
        {frame.x, frame.y + frame.height + kCaption_px - 3}, color);
}

}  // namespace

Image ContactSheet(std::span<const PhotoRecord> records) {
  const auto chosen = Chosen(records);
  const int rows = std::max(1, (static_cast<int>(chosen.size()) + kPerRow - 1) / kPerRow);
  Image image;
  image.width_px = kPerRow * kCellWidth_px;
  image.height_px = rows * kCellHeight_px;
  image.data.resize(static_cast<size_t>(image.width_px) * image.height_px * 3);
  cv::Mat sheet(image.height_px, image.width_px, CV_8UC3, image.data.data());
  sheet.setTo(kPaper);
  for (size_t i = 0; i < chosen.size(); ++i) {
    const int row = static_cast<int>(i) / kPerRow;
    const int column = static_cast<int>(i) % kPerRow;
    DrawCell(*chosen[i], {column * kCellWidth_px, row * kCellHeight_px}, sheet);
  }
  return image;
}

}  // namespace stucco
