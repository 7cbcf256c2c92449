#pragma once

#include <cstddef>
#include <cstdint>

// The door between our programs and the image module: plain C, so that nothing of OpenImageIO is
// linked into them. Both sides are built together; the version guards against a stale module.

extern "C" {

/// Receives bytes; `context` is the caller's own.
typedef void (*SphparamBytesSink)(void* context, const char* bytes, size_t size);

/// Receives a text of the file's metadata, ended by zero.
typedef void (*SphparamTextSink)(void* context, const char* name, const char* value);

/// Gives room for width·height·channels floats, or null to stop.
typedef float* (*SphparamPixelRoom)(void* context, int width, int height, int channels);

/// Writes bytes at a place of a file, which may be before its end. Returns 0 unless it cannot.
typedef int (*SphparamBytesAt)(void* context, int64_t offset, const void* bytes, size_t size);

/// A file that is written row by row.
struct SphparamImageFile {
  const char* format;       // "png", "jpeg", "tiff", "openexr"
  const char* sample_type;  // "uint8", "uint16", "half" or "float"; rows come so, half as float
  int width, height, channels;
  int tile;                  // 0: scanlines; else tiles of this side, all levels down to one texel
  int wraps;                 // 1: periodic in u, clamped in v: what a reader of tiles is told
  const char* const* metadata;  // names and values in turn
  size_t metadata_count;
  SphparamBytesAt write;
  void* context;
};

struct SphparamImageTable {
  int version;

  /// Decodes a file in memory with the named decoder; `text` may be null. Returns 0, or 1 after telling `error` why.
  int (*decode)(const char* format, const char* bytes, size_t size, int64_t max_megabytes,
                int max_channels, SphparamPixelRoom room, void* room_context,
                SphparamTextSink text, void* text_context, SphparamBytesSink error,
                void* error_context);

  /// Encodes width·height·channels floats. sample_type: "uint8", "uint16", "half" or "float";
  /// metadata: names and values in turn. Returns as decode does.
  int (*encode)(const char* format, const char* sample_type, const float* pixels, int width,
                int height, int channels, const char* const* metadata, size_t metadata_count,
                SphparamBytesSink out, void* out_context, SphparamBytesSink error,
                void* error_context);

  /// Opens a file; null after telling `error` why not. The context must live until `close`.
  void* (*open)(const SphparamImageFile* file, SphparamBytesSink error, void* error_context);
  /// The next rows; of tiled files whole rows of tiles, but at the end. Returns as `encode` does.
  int (*write_rows)(void* file, int first_row, int rows, const void* samples,
                    SphparamBytesSink error, void* error_context);
  /// Goes on with the next level of a tiled file. Returns as `encode` does.
  int (*next_level)(void* file, int width, int height, SphparamBytesSink error,
                    void* error_context);
  /// Ends the file; with `give_up`, however it is. The file is gone afterwards in any case.
  int (*close)(void* file, int give_up, SphparamBytesSink error, void* error_context);
};

/// The module's one exported name.
typedef const SphparamImageTable* (*SphparamImageTableFunction)();
}

constexpr int kSphparamImageTableVersion = 3;
constexpr char kSphparamImageTableName[] = "sphparam_image_table";
