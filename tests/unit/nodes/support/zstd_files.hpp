// Content packed with zstd, by tests.
#pragma once

#include <zstd.h>

#include <string>
#include <string_view>

namespace ballflow::test {

/// One frame with a checksum.
inline std::string zstd_packed(std::string_view content) {
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
  std::string out(ZSTD_compressBound(content.size()), '\0');
  out.resize(ZSTD_compress2(context, out.data(), out.size(), content.data(), content.size()));
  ZSTD_freeCCtx(context);
  return out;
}

}  // namespace ballflow::test
