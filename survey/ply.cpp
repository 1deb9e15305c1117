// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "survey/error.h"
#include "survey/internal/bytes.h"
#include "survey/internal/file_window.h"
#include "survey/point_cloud.h"
#include "survey/text.h"

// PLY, "The Stanford Triangle Format" (Turk 1994).
namespace stucco {
namespace {

using Source = internal::FileWindow;

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct ScalarName {
  std::string_view name;
  Scalar scalar;
};

constexpr std::array<ScalarName, 16> kScalarNames = {{
    {"char", Scalar::kInt8},
    {"int8", Scalar::kInt8},
    {"uchar", Scalar::kUint8},
    {"uint8", Scalar::kUint8},
    {"short", Scalar::kInt16},
    {"int16", Scalar::kInt16},
    {"ushort", Scalar::kUint16},
    {"uint16", Scalar::kUint16},
    {"int", Scalar::kInt32},
    {"int32", Scalar::kInt32},
    {"uint", Scalar::kUint32},
    {"uint32", Scalar::kUint32},
    {"float", Scalar::kFloat},
    {"float32", Scalar::kFloat},
    {"double", Scalar::kDouble},
    {"float64", Scalar::kDouble},
}};

size_t SizeOf(Scalar scalar) {
  switch (scalar) {
    case Scalar::kInt8:
    case Scalar::kUint8:
      return 1;
    case Scalar::kInt16:
    case Scalar::kUint16:
      return 2;
    case Scalar::kInt32:
    case Scalar::kUint32:
    case Scalar::kFloat:
      return 4;
    case Scalar::kDouble:
      return 8;
  }
  return 0;
}

struct Property {
  std::string name;
  Scalar type = Scalar::kFloat;
  bool is_list = false;
  Scalar count_type = Scalar::kUint8;
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
};

[[noreturn]] void Fail(const std::string& file, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: damaged PLY: {}", file, reason),
              "write the file again with the program it came from");
}

Scalar ParseScalar(std::string_view word, const std::string& file) {
  const auto found = std::ranges::find(kScalarNames, word, &ScalarName::name);
  if (found == kScalarNames.end()) Fail(file, fmt::format("unknown type \"{}\"", word));
  return found->scalar;
}

Encoding ParseEncoding(std::string_view word, const std::string& file) {
  if (word == "ascii") return Encoding::kAscii;
  if (word == "binary_little_endian") return Encoding::kLittleEndian;
  if (word == "binary_big_endian") return Encoding::kBigEndian;
  Fail(file, fmt::format("unknown format \"{}\"", word));
}

Property ParseProperty(std::string_view line, const std::string& file) {
  Property property;
  std::string_view word = TakeWord(line);
  if (word == "list") {
    property.is_list = true;
    property.count_type = ParseScalar(TakeWord(line), file);
    word = TakeWord(line);
  }
  property.type = ParseScalar(word, file);
  property.name = TakeWord(line);
  return property;
}

Header ReadHeader(Source& source, const std::string& file) {
  if (source.NextLine() != "ply") Fail(file, "does not begin with \"ply\"");
  Header header;
  bool has_format = false;
  while (const auto text = source.NextLine()) {
    std::string_view line = *text;
    const std::string_view word = TakeWord(line);
    if (word == "end_header") {
      if (!has_format) Fail(file, "has no line \"format\"");
      return header;
    }
    if (word == "format") {
      header.encoding = ParseEncoding(TakeWord(line), file);
      has_format = true;
    } else if (word == "element") {
      Element& element = header.elements.emplace_back();
      element.name = TakeWord(line);
      const auto count = ParseNumber<uint64_t>(TakeWord(line));
      if (!count) Fail(file, fmt::format("element \"{}\" has no count", element.name));
      element.count = *count;
    } else if (word == "property") {
      if (header.elements.empty()) Fail(file, "a property comes before the first element");
      header.elements.back().properties.push_back(ParseProperty(line, file));
    } else if (word != "comment" && word != "obj_info" && !word.empty()) {
      Fail(file, fmt::format("unknown line \"{}\" in the header", word));
    }
  }
  Fail(file, "has no line \"end_header\"");
}

// The values of the body one after another. A double holds every PLY scalar exactly.
class Body {
 public:
  Body(Source& source, Encoding encoding, const std::string& file)
      : source_(source), encoding_(encoding), file_(file) {}

  double Next(Scalar type) {
    if (encoding_ == Encoding::kAscii) return NextWord();
    const size_t size = SizeOf(type);
    const std::string_view ahead = source_.Peek(size);
    if (ahead.size() < size) Fail(file_, "ends too early");
    std::array<char, 8> raw{};
    std::copy_n(ahead.begin(), size, raw.begin());
    source_.Skip(size);
    if (encoding_ == Encoding::kBigEndian) std::reverse(raw.begin(), raw.begin() + size);
    return Convert(type, raw.data());
  }

  // Length of a list, of which each entry must still be there.
  size_t NextLength(const Property& list) {
    const double length = Next(list.count_type);
    if (!(length >= 0) || length != std::floor(length) ||
        length * static_cast<double>(MinBytes(list.type)) > static_cast<double>(source_.Left())) {
      Fail(file_, fmt::format("list \"{}\" is of length {}", list.name, length));
    }
    return static_cast<size_t>(length);
  }

  // A count in the header is believed only as far as the file has bytes for it.
  void CheckHolds(const Element& element) const {
    size_t row = 0;
    for (const Property& property : element.properties) {
      row += MinBytes(property.is_list ? property.count_type : property.type);
    }
    if (row == 0) {
      Fail(file_, fmt::format("element \"{}\" has no properties", element.name));
    }
    // The last ASCII number needs no blank after it.
    if (element.count > (source_.Left() + 1) / row) {
      Fail(file_, fmt::format("{} bytes cannot hold the {} \"{}\" that the header promises",
                              source_.Left(), element.count, element.name));
    }
  }

 private:
  // An ASCII number takes a digit and a blank.
  size_t MinBytes(Scalar type) const { return encoding_ == Encoding::kAscii ? 2 : SizeOf(type); }

  double NextWord() {
    const std::string_view word = source_.NextWord();
    if (word.empty()) Fail(file_, "ends too early");
    const auto number = ParseNumber<double>(word);
    if (!number) Fail(file_, fmt::format("\"{}\" is not a number", word));
    return *number;
  }

  static double Convert(Scalar type, const char* raw) {
    switch (type) {
      case Scalar::kInt8:
        return internal::LoadLittleEndian<int8_t>(raw);
      case Scalar::kUint8:
        return internal::LoadLittleEndian<uint8_t>(raw);
      case Scalar::kInt16:
        return internal::LoadLittleEndian<int16_t>(raw);
      case Scalar::kUint16:
        return internal::LoadLittleEndian<uint16_t>(raw);
      case Scalar::kInt32:
        return internal::LoadLittleEndian<int32_t>(raw);
      case Scalar::kUint32:
        return internal::LoadLittleEndian<uint32_t>(raw);
      case Scalar::kFloat:
        return internal::LoadLittleEndian<float>(raw);
      case Scalar::kDouble:
        return internal::LoadLittleEndian<double>(raw);
    }
    return 0;
  }

  Source& source_;
  Encoding encoding_;
  const std::string& file_;
};

void SkipElement(Body& body, const Element& element) {
  if (element.count == 0) return;
  body.CheckHolds(element);
  for (uint64_t row = 0; row < element.count; ++row) {
    for (const Property& property : element.properties) {
      const size_t values = property.is_list ? body.NextLength(property) : 1;
      for (size_t i = 0; i < values; ++i) body.Next(property.type);
    }
  }
}

// What a vertex property means to us.
enum class Meaning { kX, kY, kZ, kNx, kNy, kNz, kRed, kGreen, kBlue, kViews, kOther };

Meaning MeaningOf(const Property& property) {
  if (property.is_list) {
    return property.name == "view_indices" ? Meaning::kViews : Meaning::kOther;
  }
  constexpr std::array<std::string_view, 9> kNames = {"x",  "y",   "z",     "nx",  "ny",
                                                      "nz", "red", "green", "blue"};
  const auto found = std::ranges::find(kNames, property.name);
  return found == kNames.end() ? Meaning::kOther : static_cast<Meaning>(found - kNames.begin());
}

uint8_t ColorByte(double value, Scalar type) {
  // Some programs write colours as floats from 0 to 1.
  const bool is_share = type == Scalar::kFloat || type == Scalar::kDouble;
  const double byte = std::round(is_share ? value * 255 : value);
  return static_cast<uint8_t>(byte >= 0 ? std::min(byte, 255.0) : 0.0);  // NaN becomes 0
}

uint32_t PhotoNumber(double value, const std::string& file) {
  if (!(value >= 0 && value <= std::numeric_limits<uint32_t>::max()) ||
      value != std::floor(value)) {
    Fail(file, fmt::format("{} in \"view_indices\" is no photo number", value));
  }
  return static_cast<uint32_t>(value);
}

struct Vertex {
  std::array<double, 6> numbers{};  // x y z nx ny nz
  std::array<uint8_t, 3> color{};
  std::vector<uint32_t> views;
};

Vertex ReadVertex(Body& body, const Element& element, const std::vector<Meaning>& meanings,
                  const std::string& file) {
  Vertex vertex;
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const Property& property = element.properties[i];
    const int meaning = static_cast<int>(meanings[i]);
    if (property.is_list) {
      const size_t length = body.NextLength(property);
      for (size_t k = 0; k < length; ++k) {
        const double value = body.Next(property.type);
        if (meanings[i] == Meaning::kViews) vertex.views.push_back(PhotoNumber(value, file));
      }
      continue;
    }
    const double value = body.Next(property.type);
    if (meanings[i] <= Meaning::kNz) {
      vertex.numbers[meaning] = value;
    } else if (meanings[i] <= Meaning::kBlue) {
      vertex.color[meaning - static_cast<int>(Meaning::kRed)] = ColorByte(value, property.type);
    }
  }
  std::ranges::sort(vertex.views);
  vertex.views.erase(std::unique(vertex.views.begin(), vertex.views.end()), vertex.views.end());
  return vertex;
}

// Other programs round normals to few digits; ours are left to the last bit.
Eigen::Vector3f UnitNormal(const std::array<double, 6>& numbers) {
  const Eigen::Vector3d normal(numbers[3], numbers[4], numbers[5]);
  constexpr double kFloatRounding = 1e-6;
  const double length = normal.norm();
  const bool keep = !(length > 0) || std::abs(length - 1) < kFloatRounding;
  return (keep ? normal : Eigen::Vector3d(normal / length)).cast<float>();
}

struct VertexElement {
  const Element& element;
  std::vector<Meaning> meanings;
  PlyLayout layout;
};

VertexElement Understand(const Element& element, const std::string& file) {
  VertexElement vertices{.element = element, .meanings = {}, .layout = {}};
  for (const Property& property : element.properties) {
    vertices.meanings.push_back(MeaningOf(property));
  }
  const auto has = [&](std::initializer_list<Meaning> wanted) {
    return std::ranges::all_of(wanted, [&](Meaning meaning) {
      return std::ranges::find(vertices.meanings, meaning) != vertices.meanings.end();
    });
  };
  if (!has({Meaning::kX, Meaning::kY, Meaning::kZ})) Fail(file, "its points have no x, y and z");
  vertices.layout = {.points = element.count,
                     .normals = has({Meaning::kNx, Meaning::kNy, Meaning::kNz}),
                     .colors = has({Meaning::kRed, Meaning::kGreen, Meaning::kBlue}),
                     .views = has({Meaning::kViews})};
  return vertices;
}

void VisitVertex(Body& body, const VertexElement& vertices, uint64_t row, const std::string& file,
                 const PointVisit& visit) {
  constexpr float kUnitTolerance = 1e-3F;
  const Vertex vertex = ReadVertex(body, vertices.element, vertices.meanings, file);
  CloudPoint point;
  point.position = {vertex.numbers[0], vertex.numbers[1], vertex.numbers[2]};
  if (!point.position.allFinite()) Fail(file, fmt::format("point {} is not finite", row));
  if (vertices.layout.normals) {
    point.normal = UnitNormal(vertex.numbers);
    if (!(std::abs(point.normal.norm() - 1) <= kUnitTolerance)) {
      Fail(file, fmt::format("the normal of point {} is not of unit length", row));
    }
  }
  if (vertices.layout.colors) point.color = vertex.color;
  point.views = vertex.views;
  visit(point);
}

// Goes to the points of the file and calls `found` with what they have, before the first of them.
template <typename Found>
void FindPoints(const std::filesystem::path& path, const Found& found) {
  const std::string file = path.string();
  Source source(path);
  const Header header = ReadHeader(source, file);
  Body body(source, header.encoding, file);
  for (const Element& element : header.elements) {
    if (element.name != "vertex") {
      SkipElement(body, element);
      continue;
    }
    const VertexElement vertices = Understand(element, file);
    body.CheckHolds(element);
    found(source, body, vertices);
    return;  // faces and the like come after and are not needed
  }
  Fail(file, "has no points");
}

}  // namespace

PlyLayout ReadPlyLayout(const std::filesystem::path& path) {
  PlyLayout layout;
  FindPoints(path,
             [&](Source&, Body&, const VertexElement& vertices) { layout = vertices.layout; });
  return layout;
}

PlyPlace ForSomePoints(const std::filesystem::path& path, const PlyPlace& from, uint64_t count,
                       const PointVisit& visit) {
  PlyPlace to = from;
  FindPoints(path, [&](Source& source, Body& body, const VertexElement& vertices) {
    if (from.point > 0) source.GoTo(from.byte);
    const uint64_t end = from.point + std::min(count, vertices.layout.points - from.point);
    for (; to.point < end; ++to.point) {
      VisitVertex(body, vertices, to.point, path.string(), visit);
    }
    to.byte = source.At();
  });
  return to;
}

void ForEachPoint(const std::filesystem::path& path, const PointVisit& visit) {
  ForSomePoints(path, {}, std::numeric_limits<uint64_t>::max(), visit);
}

PointCloud ReadPly(const std::filesystem::path& path) {
  PointCloud cloud;
  FindPoints(path, [&](Source&, Body& body, const VertexElement& vertices) {
    const PlyLayout& layout = vertices.layout;
    cloud.positions.reserve(layout.points);
    if (layout.normals) cloud.normals.reserve(layout.points);
    if (layout.colors) cloud.colors.reserve(layout.points);
    if (layout.views) cloud.views.reserve(layout.points);
    for (uint64_t row = 0; row < layout.points; ++row) {
      VisitVertex(body, vertices, row, path.string(), [&](const CloudPoint& point) {
        cloud.positions.push_back(point.position);
        if (layout.normals) cloud.normals.push_back(point.normal);
        if (layout.colors) cloud.colors.push_back(point.color);
        if (layout.views) cloud.views.emplace_back(point.views.begin(), point.views.end());
      });
    }
  });
  return cloud;
}

}  // namespace stucco
