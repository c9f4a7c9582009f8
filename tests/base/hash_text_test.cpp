#include "engine/base/hash_text.hpp"

#include <gtest/gtest.h>

namespace spheroscope {
namespace {

TEST(HashText, HasSixteenDigitsAndIsReadAgain) {
    EXPECT_EQ(hash_text(0), "0000000000000000");
    EXPECT_EQ(hash_text(0x0123456789abcdefULL), "0123456789abcdef");
    for (const std::uint64_t hash : {0ULL, 1ULL, 0xfedcba9876543210ULL, ~0ULL})
        EXPECT_EQ(hash_of_text(hash_text(hash)), hash);
}

TEST(HashText, OfAnotherFormIsNone) {
    for (const char* text : {"", "12", "0123456789abcdeg", "0123456789abcdef0", "-123456789abcdef"})
        EXPECT_FALSE(hash_of_text(text)) << text;
}

}  // namespace
}  // namespace spheroscope
