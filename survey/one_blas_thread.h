// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace stucco {

// From now on BLAS, whichever library the machine has for it (OpenBLAS, MKL, BLIS), works on the
// calling thread alone: sums of several threads differ in their last digits with their number, and
// so would the sparse solutions that are made of them. Returns whether there was one to tell.
bool UseOneBlasThread();

}  // namespace stucco
