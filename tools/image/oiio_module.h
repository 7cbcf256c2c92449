#pragma once

#include <cstddef>
#include <cstdint>

// The door between our programs and the image module: plain C, so that nothing of OpenImageIO is
// linked into them. Both sides are built together; the version guards against a stale module.

extern "C" {

/// Receives bytes; `context` is the caller's own.
typedef void (*SphparamBytesSink)(void* context, const char* bytes, size_t size);

/// Gives room for width·height·channels floats, or null to stop.
typedef float* (*SphparamPixelRoom)(void* context, int width, int height, int channels);

struct SphparamImageTable {
  int version;

  /// Decodes a file in memory with the named decoder. Returns 0, or 1 after telling `error` why.
  int (*decode)(const char* format, const char* bytes, size_t size, int64_t max_megabytes,
                int max_channels, SphparamPixelRoom room, void* room_context,
                SphparamBytesSink error, void* error_context);

  /// Encodes width·height·channels floats. sample_type: "uint8", "uint16", "half" or "float";
  /// metadata: names and values in turn. Returns as decode does.
  int (*encode)(const char* format, const char* sample_type, const float* pixels, int width,
                int height, int channels, const char* const* metadata, size_t metadata_count,
                SphparamBytesSink out, void* out_context, SphparamBytesSink error,
                void* error_context);
};

/// The module's one exported name.
typedef const SphparamImageTable* (*SphparamImageTableFunction)();
}

constexpr int kSphparamImageTableVersion = 1;
constexpr char kSphparamImageTableName[] = "sphparam_image_table";
