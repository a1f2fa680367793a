#include "trace/position_delta.h"

#include <zstd.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>

#include "mesh/error.h"

namespace isorelax {
namespace {

constexpr std::size_t kBytes = sizeof(double);
static_assert(std::endian::native == std::endian::little, "traces are written as the machine stores numbers");
static_assert(sizeof(Vec3) == 3 * sizeof(double));

struct FreeContext {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

}  // namespace

std::string compress(std::string_view bytes) {
  const std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, 1);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress2(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0) throw Error(std::string("cannot compress: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  packed.shrink_to_fit();
  return packed;
}

bool decompress(std::string_view packed, std::size_t size, std::string& bytes) {
  // The frame's own word for its size, before anything is allocated by it.
  if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != size) return false;
  bytes.resize(size);
  return ZSTD_decompress(bytes.data(), size, packed.data(), packed.size()) == size;
}

std::string encode_delta(std::span<const Vec3> from, std::span<const Vec3> to) {
  const std::size_t count = 3 * from.size();
  std::string planes(kBytes * count, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t changed = bits(from[i / 3][static_cast<Eigen::Index>(i % 3)]) ^
                                  bits(to[i / 3][static_cast<Eigen::Index>(i % 3)]);
    for (std::size_t byte = 0; byte < kBytes; ++byte)
      planes[byte * count + i] = static_cast<char>(changed >> (8 * byte));
  }
  return compress(planes);
}

bool apply_delta(std::string_view delta, std::span<Vec3> positions) {
  const std::size_t count = 3 * positions.size();
  std::string planes;
  if (!decompress(delta, kBytes * count, planes)) return false;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t changed = 0;
    for (std::size_t byte = 0; byte < kBytes; ++byte)
      changed |= std::uint64_t{static_cast<unsigned char>(planes[byte * count + i])} << (8 * byte);
    double& x = positions[i / 3][static_cast<Eigen::Index>(i % 3)];
    x = std::bit_cast<double>(bits(x) ^ changed);
  }
  return true;
}

}  // namespace isorelax
