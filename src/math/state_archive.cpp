#include "spring_workbench/math/state_archive.h"

#include "constants.h"

namespace spring_workbench::math {
namespace {

const char* const hexadecimal = "0123456789abcdef";

}  // namespace

std::string to_hex(std::uint64_t word) {
  std::string text(word_digits, '0');
  for (std::size_t i = word_digits; i-- > 0; word /= 16u) text[i] = hexadecimal[word % 16u];
  return text;
}

std::optional<StateArchive::Words> words_of_hex(const std::string& text) {
  if (text.size() % word_digits != 0 || text.find_first_not_of(hexadecimal) != std::string::npos) return std::nullopt;
  StateArchive::Words words;
  for (std::size_t at = 0; at < text.size(); at += word_digits) {
    words.push_back(std::stoull(text.substr(at, word_digits), nullptr, 16));
  }
  return words;
}

}  // namespace spring_workbench::math
