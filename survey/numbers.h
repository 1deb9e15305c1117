// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace stucco {

// The nearest multiple of 1 / unit_inverse, as files carry numbers: the same bytes where two
// machines differ in the last bits.
double RoundTo(double value, double unit_inverse);

// How numbers are written for people. Lengths are metres only where the survey is metric; else they
// are called units, because nothing fixes their scale.
std::string Percent(double share);                // "54 %"; "-" when not a number
std::string Decimal(double value, int decimals);  // "0.62"; "-" when not a number
std::string PixelSize(double size, bool metric);  // "1.24 cm" or "0.0124 units"
std::string Length(double length, bool metric);   // "3.42 m" or "3.42 units"
std::string Area(double area, bool metric);       // "34.2 m²" or "34.2 units²"
std::string Duration(double seconds);             // "2 h 05 min", "3 min 20 s", "4.2 s"
std::string Count(int count, const char* one, const char* many);  // "1 photo", "3 photos"

}  // namespace stucco
