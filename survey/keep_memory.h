// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace stucco {

// Of the whole process: blocks of up to 32 MiB that were freed are used again, instead of going
// back to the system and coming from it anew, page by page and each filled with zeros. Pictures of
// a few megapixels are such blocks, and every photo needs dozens. What is held back is free between
// stages (malloc_trim). Does nothing where the C library is another than glibc.
void KeepFreedMemory();

}  // namespace stucco
