#pragma once

#include <cstddef>
#include <cstdint>

/// Decodes the bytes, all at once and in pieces, in the mode that the first two of them choose, and aborts where the
/// two differ, or a record is none that a tracker can measure. Always 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
