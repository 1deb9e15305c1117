// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/one_blas_thread.h"

#include <gtest/gtest.h>

namespace {

int g_told = 0;

}  // namespace

// As MKL has it; the test program shows its symbols, as a library would.
extern "C" void MKL_Set_Num_Threads(int threads) {
  g_told = threads;
}

namespace stucco {
namespace {

TEST(UseOneBlasThread, TellsTheLibraryThatTheMachineHas) {
  EXPECT_TRUE(UseOneBlasThread());
  EXPECT_EQ(g_told, 1);
}

}  // namespace
}  // namespace stucco
