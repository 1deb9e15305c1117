// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "survey/keep_memory.h"
#include "tests/survey/temporary_folder.h"

// Of every test program: testing::TempDir() is a folder of its own, removed afterwards, so that
// tests can run beside each other.
int main(int argc, char** argv) {
  stucco::KeepFreedMemory();
  const stucco::test::TemporaryFolder folder;
  setenv("TEST_TMPDIR", (folder.path() / "").c_str(), 1);
  testing::InitGoogleMock(&argc, argv);
  return RUN_ALL_TESTS();
}
