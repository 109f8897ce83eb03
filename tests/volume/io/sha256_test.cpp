// SHA-256 against the examples of FIPS 180-4 and messages of every length around the block size.
#include "volume/io/sha256.h"

#include <gtest/gtest.h>

#include "tests/support/volume_files.h"

namespace deliso {
namespace {

std::string hash_of(std::string_view message) {
  Sha256 hash;
  hash.update(std::as_bytes(std::span(message)));
  return hash.finish();
}

TEST(Sha256, PublishedExamples) {
  EXPECT_EQ(hash_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(
      hash_of("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnop"
              "qrstnopqrstu"),
      "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(hash_of(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, PiecesOfAnySizeGiveTheHashOfTheWhole) {
  std::string message;
  for (int n = 0; n < 300; ++n) message += static_cast<char>(n * 7);
  for (std::size_t length = 0; length <= message.size(); ++length) {
    Rng rng(length);
    Sha256 hash;
    std::size_t done = 0;
    while (done < length) {
      const std::size_t piece = std::min<std::size_t>(length - done, rng.below(130));
      hash.update(std::as_bytes(std::span(message).subspan(done, piece)));
      done += piece;
    }
    EXPECT_EQ(hash.finish(), hash_of(std::string_view(message).substr(0, length))) << length;
  }
}

// The test of published examples sees only one of the two.
TEST(Sha256, BlocksAreTakenAsTheStandardHasIt) {
  Rng rng(7);
  Sha256State state{}, plain{};
  for (int block = 0; block < 1000; ++block) {
    std::array<std::byte, 64> bytes{};
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(rng.below(256));
    compress(state, bytes.data());
    compress_plainly(plain, bytes.data());
    ASSERT_EQ(state, plain) << block;
  }
  EXPECT_NE(state, Sha256State{});
}

TEST(Sha256, SamplesAreHashedLittleEndian) {
  const ScalarGrid grid({2, 2, 2}, std::vector<std::uint16_t>{0x0102, 3, 4, 5, 6, 7, 8, 0xFFFE});
  EXPECT_EQ(sample_sha256(grid), hash_of(std::string_view("\x02\x01\x03\0\x04\0\x05\0\x06\0\x07\0\x08\0\xFE\xFF", 16)));
}

}  // namespace
}  // namespace deliso
