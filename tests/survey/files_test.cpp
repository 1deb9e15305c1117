// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/files.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "tests/survey/support.h"

namespace stucco {
namespace {

using test::ErrorOf;
using test::ExpectBadInput;
using test::TemporaryFolder;

size_t NumEntries(const std::filesystem::path& folder) {
  return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(Files, ReadsWhatWasWritten) {
  const TemporaryFolder folder;
  std::string bytes(3'000'001, '\0');
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i >> 3);
  for (const std::string& text : {std::string(), std::string("a\0b", 3), bytes}) {
    WriteFile(folder / "file", text);
    EXPECT_EQ(ReadFile(folder / "file"), text);
    WriteFileAtomically(folder / "atomic", text);
    EXPECT_EQ(ReadFile(folder / "atomic"), text);
  }
  EXPECT_EQ(NumEntries(folder.path()), 2u);
}

TEST(Files, ReadsFilesThatHaveNoSize) {
  EXPECT_FALSE(ReadFile("/proc/self/status").empty());
}

TEST(Files, NamesFileAndReason) {
  const TemporaryFolder folder;
  ExpectBadInput([&] { ReadFile(folder / "none"); }, "none: cannot be read: No such file");
  ExpectBadInput([&] { HashFile(folder / "none"); }, "none: cannot be read: No such file");
  ExpectBadInput([&] { ReadFile(folder.path()); }, "cannot be read: Is a directory");
  ExpectBadInput([&] { WriteFile(folder / "no/file", "x"); },
                 "no/file: cannot be written: No such");
  ExpectBadInput([&] { WriteFileAtomically(folder / "no/file", "x"); },
                 "cannot be written: No such");
}

TEST(Files, FullDiskIsAResource) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const Error error = ErrorOf([] { WriteFile("/dev/full", "x"); });
  EXPECT_EQ(error.kind(), ErrorKind::kOutOfResource);
  EXPECT_NE(error.remedy().find("free space"), std::string::npos);
}

TEST(Files, AFailedAtomicWriteLeavesTheOldFile) {
  const TemporaryFolder folder;
  // A folder stands where the file should go, so that the rename fails.
  std::filesystem::create_directories(folder / "target/inside");
  ExpectBadInput([&] { WriteFileAtomically(folder / "target", "x"); }, "cannot be written");
  EXPECT_EQ(NumEntries(folder.path()), 1u);
  EXPECT_TRUE(std::filesystem::exists(folder / "target/inside"));
}

TEST(Files, AtomicWriteTakesNamesWithoutFolder) {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  WriteFileAtomically("plain", "x");
  std::filesystem::current_path(before);
  EXPECT_EQ(ReadFile(folder / "plain"), "x");
}

TEST(Hash, IsXxh3Of128Bits) {
  // Values of xxhsum -H2.
  EXPECT_EQ(HashBytes(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(HashBytes("a"), "a96faf705af16834e6c632b61e964e1f");
}

TEST(Hash, OfAFileIsThatOfItsBytes) {
  const TemporaryFolder folder;
  for (const size_t size : {size_t{0}, size_t{1}, size_t{1} << 20, (size_t{5} << 19) + 7}) {
    const std::string bytes(size, 'x');
    WriteFile(folder / "file", bytes);
    EXPECT_EQ(HashFile(folder / "file"), HashBytes(bytes)) << size;
  }
}

TEST(Hash, OfPartsKnowsWhereTheyEnd) {
  const auto hash = [](const std::vector<std::string>& parts) { return HashParts(parts); };
  EXPECT_NE(hash({"ab", "c"}), hash({"a", "bc"}));
  EXPECT_NE(hash({"abc"}), hash({"abc", ""}));
  EXPECT_NE(hash({}), hash({""}));
  EXPECT_EQ(hash({"ab", "c"}), hash({"ab", "c"}));
  EXPECT_EQ(hash({"ab", "c"}).size(), 32u);
}

}  // namespace
}  // namespace stucco
