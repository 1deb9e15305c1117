// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/lpips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <opencv2/dnn.hpp>

#include "evaluate/figures/evaluation.h"
#include "evaluate/picture/internal/planes.h"
#include "survey/error.h"
#include "survey/files.h"

namespace stucco::evaluate {

struct Lpips::State {
  std::string name;
  cv::dnn::Net net;
  std::mutex busy;  // a network holds what it computes
};

namespace {

constexpr int kTile_px = 256;
constexpr char kRemedy[] =
    "export the network with inputs \"in0\" and \"in1\" of 1 x 3 x 256 x 256 (docs/evaluation.md)";

// OpenCV's messages run over several lines, with the place in its own sources.
std::string FirstLine(const cv::Exception& error) {
  return error.err.substr(0, error.err.find('\n'));
}

cv::Mat Blob(const cv::Mat& rgb) {
  return cv::dnn::blobFromImage(rgb, 1 / 127.5, {}, cv::Scalar(127.5, 127.5, 127.5));
}

double Run(cv::dnn::Net& net, const std::string& name, const cv::Mat& truth,
           const cv::Mat& result) {
  cv::Mat output;
  try {
    net.setInput(Blob(truth), "in0");
    net.setInput(Blob(result), "in1");
    output = net.forward();
  } catch (const cv::Exception& error) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: the network cannot compare two pictures: {}", name, FirstLine(error)),
        kRemedy);
  }
  const double distance =
      output.empty() || output.depth() != CV_32F ? kNotMeasured : cv::mean(output.reshape(1, 1))[0];
  if (!std::isfinite(distance)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: the network's output is no number", name),
                kRemedy);
  }
  return distance;
}

// Starts of tiles over a side; the last one is moved back so that it ends with the picture.
std::vector<int> Starts(int side_px) {
  std::vector<int> starts;
  for (int start = 0; start < side_px; start += kTile_px) {
    starts.push_back(std::min(start, side_px - kTile_px));
  }
  return starts;
}

}  // namespace

Lpips::Lpips(const std::filesystem::path& model) : state_(std::make_unique<State>()) {
  state_->name = model.string();
  const std::string bytes = ReadFile(model);
  try {
    state_->net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    state_->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    state_->net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  } catch (const cv::Exception& error) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: not an ONNX network that OpenCV reads: {}", state_->name,
                            FirstLine(error)),
                kRemedy);
  }
  const cv::Mat grey(kTile_px, kTile_px, CV_8UC3, cv::Scalar::all(128));
  Run(state_->net, state_->name, grey, grey);  // so that a wrong network is found at once
}

Lpips::~Lpips() = default;
Lpips::Lpips(Lpips&&) noexcept = default;
Lpips& Lpips::operator=(Lpips&&) noexcept = default;

double Lpips::Distance(const PicturePair& pair) const {
  CheckPair(pair);
  const cv::Mat mask = internal::MaskOf(pair);
  if (mask.cols < kTile_px || mask.rows < kTile_px) return kNotMeasured;
  const cv::Mat truth = internal::Rgb(pair.truth);
  cv::Mat result = truth.clone();
  internal::Rgb(pair.result).copyTo(result, mask);
  const std::lock_guard lock(state_->busy);
  double sum = 0;
  double weight = 0;
  for (const int y : Starts(mask.rows)) {
    for (const int x : Starts(mask.cols)) {
      const cv::Rect tile(x, y, kTile_px, kTile_px);
      const int inside = cv::countNonZero(mask(tile));
      if (2 * inside < tile.area()) continue;
      sum += inside * Run(state_->net, state_->name, truth(tile), result(tile));
      weight += inside;
    }
  }
  return weight > 0 ? sum / weight : kNotMeasured;
}

}  // namespace stucco::evaluate
