// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/keep_memory.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace stucco {

void KeepFreedMemory() {
#ifdef __GLIBC__
  // mallopt(3): the largest threshold it takes. Setting the second alone would set the first back
  // to 128 KiB, since glibc then no longer raises both by itself.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

}  // namespace stucco
