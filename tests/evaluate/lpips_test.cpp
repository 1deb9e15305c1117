// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/lpips.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "evaluate/picture/measure.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/evaluate/made_pictures.h"

namespace stucco::evaluate {
namespace {

// Just enough of protocol buffers to write a network: numbers and texts with their field's number.
std::string Varint(uint64_t value) {
  std::string bytes;
  while (value > 127) {
    bytes += static_cast<char>(value % 128 + 128);
    value /= 128;
  }
  return bytes + static_cast<char>(value);
}

std::string Number(int field, uint64_t value) {
  return Varint(static_cast<uint64_t>(field) * 8) + Varint(value);
}

std::string Text(int field, const std::string& text) {
  return Varint(static_cast<uint64_t>(field) * 8 + 2) + Varint(text.size()) + text;
}

std::string Node(const std::vector<std::string>& inputs, const std::string& output,
                 const std::string& operation) {
  std::string node;
  for (const std::string& input : inputs) node += Text(1, input);
  return Text(1, node + Text(2, output) + Text(3, "make " + output) + Text(4, operation));
}

std::string Tensor(int field, const std::string& name, const std::vector<int>& shape) {
  std::string dimensions;
  for (const int size : shape) dimensions += Text(1, Number(1, static_cast<uint64_t>(size)));
  const std::string type = Text(1, Number(1, 1) + Text(2, dimensions));  // of floats
  return Text(field, Text(1, name) + Text(2, type));
}

// The mean square difference of its two inputs: (a - b)^2, mean over the picture.
std::string SquareDifference(const std::string& first, const std::string& second) {
  const std::string graph = Node({first, second}, "d", "Sub") + Node({"d", "d"}, "s", "Mul") +
                            Node({"s"}, "out", "GlobalAveragePool") + Text(2, "net") +
                            Tensor(11, first, {1, 3, 256, 256}) +
                            Tensor(11, second, {1, 3, 256, 256}) + Tensor(12, "out", {1, 3, 1, 1});
  return Number(1, 7) + Text(7, graph) + Text(8, Text(1, "") + Number(2, 11));
}

std::filesystem::path FileWith(const std::string& bytes, const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
  WriteFile(path, bytes);
  return path;
}

std::string ComplaintAbout(const std::filesystem::path& model) {
  try {
    Lpips network(model);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    return error.what();
  }
  return "no complaint";
}

TEST(Lpips, RunsTheNetworkOnTiles) {
  const Lpips network(FileWith(SquareDifference("in0", "in1"), "square.onnx"));
  const Image truth = Plain(300, 256, 100, 100, 100);
  EXPECT_EQ(network.Distance({truth, truth, {}}), 0);
  // 51 codes are 0.4 of the range from -1 to 1; the pooling sums 65536 floats one by one.
  const Image brighter = Plain(300, 256, 151, 151, 151);
  EXPECT_NEAR(network.Distance({truth, brighter, {}}), 0.16, 2e-4);
  EXPECT_NEAR(MeasurePair({truth, brighter, {}}, &network).figures.lpips, 0.16, 2e-4);
  EXPECT_TRUE(std::isnan(MeasurePair({truth, brighter, {}}).figures.lpips));
}

TEST(Lpips, LeavesOutWhatIsHiddenAndSmall) {
  const Lpips network(FileWith(SquareDifference("in0", "in1"), "square.onnx"));
  const Image truth = Plain(512, 256, 100, 100, 100);
  Image result = truth;
  std::vector<uint8_t> mask(size_t{512} * 256, 1);
  for (int y = 0; y < 256; ++y) {
    for (int x = 256; x < 512; ++x) {
      mask[static_cast<size_t>(y) * 512 + x] = 0;
      for (int c = 0; c < 3; ++c) result.Pixel(x, y)[c] = 255;
    }
  }
  EXPECT_EQ(network.Distance({truth, result, mask}), 0);
  EXPECT_TRUE(
      std::isnan(network.Distance({Plain(255, 256, 0, 0, 0), Plain(255, 256, 0, 0, 0), {}})));
  std::fill(mask.begin(), mask.end(), uint8_t{0});
  EXPECT_TRUE(std::isnan(network.Distance({truth, result, mask})));
}

TEST(Lpips, SaysWhatIsWrongWithANetwork) {
  EXPECT_THAT(ComplaintAbout("/nowhere/net.onnx"), testing::HasSubstr("/nowhere/net.onnx"));
  EXPECT_THAT(ComplaintAbout(FileWith("no network", "text.onnx")),
              testing::HasSubstr("not an ONNX network"));
  EXPECT_THAT(ComplaintAbout(FileWith("", "empty.onnx")), testing::HasSubstr("empty.onnx"));
  EXPECT_THAT(ComplaintAbout(FileWith(SquareDifference("left", "right"), "names.onnx")),
              testing::HasSubstr("cannot compare two pictures"));
}

}  // namespace
}  // namespace stucco::evaluate
