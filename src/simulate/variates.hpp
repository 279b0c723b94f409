// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace trueaxis::virtual_lathe {

/// Philox4x32-10 (Salmon et al., Parallel random numbers: as easy as 1, 2, 3, 2011): a bijection of
/// the counter for every key, so that any counter can be asked for without those before it.
inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53U} * counter[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57U} * counter[2];
    counter = {
        static_cast<std::uint32_t>(b >> 32U) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
        static_cast<std::uint32_t>(a >> 32U) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9U;
    key[1] += 0xBB67AE85U;
  }
  return counter;
}

/// The 64 bits at (high, low) of a key.
inline std::uint64_t hashed(std::uint64_t key, std::uint64_t high, std::uint64_t low) {
  const auto half = [](std::uint64_t value, unsigned shift) {
    return static_cast<std::uint32_t>(value >> shift);
  };
  const auto out = philox({half(low, 0), half(low, 32), half(high, 0), half(high, 32)},
                          {half(key, 0), half(key, 32)});
  return out[0] | std::uint64_t{out[1]} << 32U;
}

/// xoshiro256++ (Blackman and Vigna, 2021): 64 bits in a nanosecond; seeded by Philox, one sequence
/// a purpose.
class Xoshiro {
 public:
  Xoshiro(std::uint64_t seed, std::uint32_t purpose) {
    for (std::uint32_t i = 0; i < 4; ++i) state_[i] = hashed(seed, purpose, i);
  }

  std::uint64_t operator()() {
    const std::uint64_t out = turned(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17U;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = turned(state_[3], 45);
    return out;
  }

  /// On [0, 1), 53 bits.
  double uniform() { return static_cast<double>(operator()() >> 11U) * 0x1p-53; }

 private:
  static std::uint64_t turned(std::uint64_t value, unsigned by) {
    return value << by | value >> (64U - by);
  }
  std::array<std::uint64_t, 4> state_{};
};

/// Standard normal, by the ziggurat of 256 layers (Marsaglia and Tsang, 2000; layer and position
/// from different bits, Doornik, 2005). The same bits on every platform: tables and the rare cases
/// use exp and log of this file only.
double normal_variate(Xoshiro& bits);

/// Adds `sigma` times a normal variate each; bits and order are those of normal_variate.
void add_normal_variates(Xoshiro& bits, double sigma, std::span<double> to);

/// Student's t with `dof` > 2, scaled to standard deviation 1.
double student_variate(Xoshiro& bits, double dof);

}  // namespace trueaxis::virtual_lathe
