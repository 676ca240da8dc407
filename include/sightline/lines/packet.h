#pragma once

#include <cstddef>
#include <cstring>

/// Attribute of a function with a loop over packets: compiled for AVX2, too, where the compiler
/// can, and chosen by the processor when the program is loaded. Sanitizers are not ready that
/// early.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define SIGHTLINE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SIGHTLINE_VECTOR_CLONES
#endif

namespace sightline::lines {

/// Beams that are computed side by side.
constexpr std::size_t kLanes = 4;

/// One number for each of them, in one vector register: left to themselves, compilers unroll the
/// loops over the beams instead, at a fraction of the speed. Seven digits serve for what is of one
/// beam, a thousandth of a millimetre in ten metres; whatever is estimated is held in double.
using Packet = float __attribute__((vector_size(kLanes * sizeof(float))));

inline Packet load(const float* from) {
  Packet packet;
  std::memcpy(&packet, from, sizeof(packet));
  return packet;
}

inline Packet all(float value) {
  return Packet{value, value, value, value};
}

inline Packet smaller(const Packet& a, const Packet& b) {
  return a < b ? a : b;
}

inline Packet larger(const Packet& a, const Packet& b) {
  return a > b ? a : b;
}

/// 1 in the lanes before `count`, 0 in the others.
inline Packet firstLanes(std::size_t count) {
  return Packet{count > 0 ? 1.0F : 0.0F, count > 1 ? 1.0F : 0.0F, count > 2 ? 1.0F : 0.0F,
                count > 3 ? 1.0F : 0.0F};
}

/// The same in double. Functions return none: without AVX there is no register to do it in.
using Quad = double __attribute__((vector_size(kLanes * sizeof(double))));

inline void widen(const Packet& packet, Quad& quad) {
  quad = __builtin_convertvector(packet, Quad);
}

inline double sum(const Quad& quad) {
  return (quad[0] + quad[2]) + (quad[1] + quad[3]);
}

inline double sum(const Packet& packet) {
  return static_cast<double>(packet[0] + packet[2]) + static_cast<double>(packet[1] + packet[3]);
}

}  // namespace sightline::lines
