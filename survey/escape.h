// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace stucco {

// Well-formed UTF-8: bytes that are not become U+FFFD, and so do control characters except tab and
// line feed. Every text that comes from file names or metadata goes through here first.
std::string CleanUtf8(std::string_view text);

// Safe as the text of an element and inside a quoted attribute.
std::string EscapeHtml(std::string_view text);

// EscapeHtml inside <bdi>, so that a right-to-left name cannot turn what stands beside it.
std::string IsolatedHtml(std::string_view text);

// A field of RFC 4180: quoted where it has to be.
std::string CsvField(std::string_view text);

// A relative path as the path of a URL: "a b/ü.png" -> "a%20b/%C3%BC.png".
std::string UrlPath(std::string_view path);

std::string Base64(std::string_view bytes);

}  // namespace stucco
