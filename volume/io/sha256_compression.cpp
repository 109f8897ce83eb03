#include "volume/io/sha256_compression.h"

#include <bit>

#if defined(__x86_64__) && defined(__GNUC__)
#include <cpuid.h>
#include <immintrin.h>
#endif

namespace deliso {

namespace {

// The first 32 bits of the fractional parts of the cube roots of the first 64 primes (FIPS 180-4, section 4.2.2).
constexpr std::array<std::uint32_t, 64> kRoundConstants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

std::uint32_t big_endian_word(const std::byte* bytes) {
  std::uint32_t word = 0;
  for (std::size_t n = 0; n < 4; ++n) word = word << 8 | std::to_integer<std::uint32_t>(bytes[n]);
  return word;
}

// The message schedule of a block (section 6.2.2, step 1).
std::array<std::uint32_t, 64> schedule(const std::byte* block) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t t = 0; t < 16; ++t) w[t] = big_endian_word(block + 4 * t);
  for (std::size_t t = 16; t < 64; ++t) {
    const std::uint32_t s0 = std::rotr(w[t - 15], 7) ^ std::rotr(w[t - 15], 18) ^ (w[t - 15] >> 3);
    const std::uint32_t s1 = std::rotr(w[t - 2], 17) ^ std::rotr(w[t - 2], 19) ^ (w[t - 2] >> 10);
    w[t] = w[t - 16] + s0 + w[t - 7] + s1;
  }
  return w;
}

}  // namespace

void compress_plainly(Sha256State& state, const std::byte* block) {
  const std::array<std::uint32_t, 64> w = schedule(block);
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t choice = (e & f) ^ (~e & g);
    const std::uint32_t t1 = h + s1 + choice + kRoundConstants[t] + w[t];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t majority = (a & b) ^ (a & c) ^ (b & c);
    h = g;
    g = f;
    f = e;
    e = d + t1;
    d = c;
    c = b;
    b = a;
    a = t1 + s0 + majority;
  }
  const std::array<std::uint32_t, 8> change{a, b, c, d, e, f, g, h};
  for (std::size_t n = 0; n < 8; ++n) state[n] += change[n];
}

#if defined(__x86_64__) && defined(__GNUC__)

namespace {

bool has_instructions() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  const bool has_sse41 = __get_cpuid(1, &a, &b, &c, &d) != 0 && (c >> 19 & 1) != 0;
  return has_sse41 && __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b >> 29 & 1) != 0;
}

// The instructions take four words at a time, the first one lowest, and keep the state as a, b, e, f and as c, d, g, h,
// the first one highest.
[[gnu::target("sha,sse4.1")]] void compress_by_instructions(Sha256State& state, const std::byte* block) {
  const auto in_signed = [&state](std::size_t n) { return static_cast<int>(state[n]); };
  const __m128i abef_before = _mm_set_epi32(in_signed(0), in_signed(1), in_signed(4), in_signed(5));
  const __m128i cdgh_before = _mm_set_epi32(in_signed(2), in_signed(3), in_signed(6), in_signed(7));
  const __m128i bytes_reversed = _mm_set_epi8(12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3);
  __m128i abef = abef_before, cdgh = cdgh_before;
  __m128i w0 = abef, w1 = abef, w2 = abef, w3 = abef;  // the latest sixteen words of the schedule
  for (std::size_t t = 0; t < 64; t += 4) {
    __m128i w4;
    if (t < 16) {
      w4 = _mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(block + 4 * t)), bytes_reversed);
    } else {
      w4 = _mm_add_epi32(_mm_sha256msg1_epu32(w0, w1), _mm_alignr_epi8(w3, w2, 4));
      w4 = _mm_sha256msg2_epu32(w4, w3);
    }
    w0 = w1;
    w1 = w2;
    w2 = w3;
    w3 = w4;
    const auto* constants = reinterpret_cast<const __m128i*>(&kRoundConstants[t]);
    const __m128i sums = _mm_add_epi32(w3, _mm_loadu_si128(constants));
    cdgh = _mm_sha256rnds2_epu32(cdgh, abef, sums);
    abef = _mm_sha256rnds2_epu32(abef, cdgh, _mm_shuffle_epi32(sums, 0x0E));
  }
  Sha256State now;
  _mm_storeu_si128(reinterpret_cast<__m128i*>(now.data()), _mm_add_epi32(abef, abef_before));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(now.data() + 4), _mm_add_epi32(cdgh, cdgh_before));
  state = {now[3], now[2], now[7], now[6], now[1], now[0], now[5], now[4]};
}

}  // namespace

void compress(Sha256State& state, const std::byte* block) {
  static const bool kHasInstructions = has_instructions();
  if (kHasInstructions) {
    compress_by_instructions(state, block);
  } else {
    compress_plainly(state, block);
  }
}

#else

void compress(Sha256State& state, const std::byte* block) { compress_plainly(state, block); }

#endif

}  // namespace deliso
