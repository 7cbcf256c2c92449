#pragma once

#include <cstddef>
#include <cstdint>

// The door between our programs and the image module: plain C, so that nothing of OpenImageIO and
// libwebp is linked into them. Both sides are built together; the version guards against a stale
// module.

extern "C" {

/// Receives bytes; `context` is the caller's own.
typedef void (*SphparamBytesSink)(void* context, const char* bytes, size_t size);

/// Receives a text of the file's metadata, ended by zero.
typedef void (*SphparamTextSink)(void* context, const char* name, const char* value);

/// Gives room for width·height·channels floats, or null to stop.
typedef float* (*SphparamPixelRoom)(void* context, int width, int height, int channels);

/// Writes bytes at a place of a file, which may be before its end. Returns 0 unless it cannot.
typedef int (*SphparamBytesAt)(void* context, int64_t offset, const void* bytes, size_t size);

/// Reads bytes of a file from a place. Returns how many there are, up to `size`.
typedef size_t (*SphparamBytesFrom)(void* context, int64_t offset, void* bytes, size_t size);

/// A file that is written row by row.
struct SphparamImageFile {
  const char* format;       // "png", "jpeg", "tiff", "openexr"
  const char* sample_type;  // "uint8", "uint16", "half" or "float"; rows come so, half as float
  int width, height, channels;
  int tile;   // 0: scanlines; else tiles of this side, all levels down to one texel
  int wraps;  // 1: periodic in u, clamped in v: what a reader of tiles is told
  const char* const* metadata;  // names and values in turn
  size_t metadata_count;
  SphparamBytesAt write;
  void* context;
};

/// What a file says of one of its levels. The sample type is one of "uint8", "uint16", "half",
/// "float", or another for which there are no rows to be had.
struct SphparamImageLevel {
  const char* sample_type;
  int width, height, channels;
  int tile;  // 0: scanlines
};

/// An image that becomes a WebP file.
struct SphparamWebp {
  int width, height, channels;
  const unsigned char* samples;
  int lossless;  // 1: every sample is kept, what is transparent too
  int quality;   // else: 0 to 100; alpha is kept
};

struct SphparamImageTable {
  int version;

  /// Decodes a file in memory with the named decoder; `text` may be null. Returns 0, or 1 after
  /// telling `error` why.
  int (*decode)(const char* format, const char* bytes, size_t size, int64_t max_megabytes,
                int max_channels, SphparamPixelRoom room, void* room_context, SphparamTextSink text,
                void* text_context, SphparamBytesSink error, void* error_context);

  /// Opens a file; null after telling `error` why not. The context must live until `close`.
  void* (*open)(const SphparamImageFile* file, SphparamBytesSink error, void* error_context);
  /// The next rows; of tiled files whole rows of tiles, but at the end. Returns as `decode` does.
  int (*write_rows)(void* file, int first_row, int rows, const void* samples,
                    SphparamBytesSink error, void* error_context);
  /// Goes on with the next level of a tiled file. Returns as `decode` does.
  int (*next_level)(void* file, int width, int height, SphparamBytesSink error,
                    void* error_context);
  /// Ends the file; with `give_up`, however it is. The file is gone afterwards in any case.
  int (*close)(void* file, int give_up, SphparamBytesSink error, void* error_context);

  /// Opens a file of our own of `size` bytes to read it back, without limits; null after telling
  /// `error` why not. `text` gets the texts of its metadata. The context must live until
  /// `close_written`.
  void* (*open_written)(const char* format, SphparamBytesFrom read, void* context, int64_t size,
                        SphparamTextSink text, void* text_context, SphparamBytesSink error,
                        void* error_context);
  /// What a level is, from 0. Returns 1 where the file has no such level.
  int (*level_written)(void* file, int level, struct SphparamImageLevel* out);
  /// Rows as they are taken by `write_rows`. Returns as `decode` does.
  int (*read_rows)(void* file, int level, int first_row, int rows, void* samples,
                   SphparamBytesSink error, void* error_context);
  void (*close_written)(void* file);

  /// Encodes rows of 3 or 4 bytes a texel, alpha not multiplied in, as WebP. Returns as `decode`.
  int (*encode_webp)(const struct SphparamWebp* image, SphparamBytesSink bytes, void* context,
                     SphparamBytesSink error, void* error_context);
};

/// The module's one exported name.
typedef const SphparamImageTable* (*SphparamImageTableFunction)();
}

constexpr int sphparam_image_table_version = 8;
/// What `error` is told where memory ran out, and nowhere else.
constexpr char sphparam_image_no_memory[] = "not enough memory";
/// The name under which `decode` tells, as a text, what profile colours are in, where it is not
/// that of sRGB.
constexpr char sphparam_other_profile[] = "sphparam:other-profile";
/// The name of a text that tells of a JPEG without an end whose pixels are all there.
constexpr char sphparam_lacks_end[] = "sphparam:lacks-end";
constexpr char sphparam_image_table_name[] = "sphparam_image_table";
