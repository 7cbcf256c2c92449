#pragma once

#include <cstddef>
#include <cstdint>

// The door between our programs and the image module: plain C, so that nothing of OpenImageIO and
// libwebp is linked into them. Both sides are built together; the version guards against a stale
// module.

extern "C" {

// What the caller gives to be called; `context` is its own.

/// Receives bytes.
struct SphparamBytesSink {
  void (*take)(void* context, const char* bytes, size_t size);
  void* context;
};

/// Receives a text of the file's metadata, ended by zero.
struct SphparamTextSink {
  void (*take)(void* context, const char* name, const char* value);
  void* context;
};

/// Gives room for width·height·channels floats, or null to stop.
struct SphparamPixelRoom {
  float* (*make)(void* context, int width, int height, int channels);
  void* context;
};

/// Writes bytes at a place of a file, which may be before its end. Returns 0 unless it cannot.
struct SphparamBytesAt {
  int (*write)(void* context, int64_t offset, const void* bytes, size_t size);
  void* context;
};

/// Reads bytes of a file from a place. Returns how many there are, up to `size`.
struct SphparamBytesFrom {
  size_t (*read)(void* context, int64_t offset, void* bytes, size_t size);
  void* context;
};

/// What is refused before any pixel is allocated.
struct SphparamImageLimits {
  int64_t megabytes;
  int channels;
};

/// A file that is written row by row.
struct SphparamImageFile {
  const char* format;       // "png", "jpeg", "tiff", "openexr"
  const char* sample_type;  // "uint8", "uint16", "half" or "float"; rows come so, half as float
  int width, height, channels;
  int tile;   // 0: scanlines; else tiles of this side, all levels down to one texel
  int wraps;  // 1: periodic in u, clamped in v: what a reader of tiles is told
  const char* const* metadata;  // names and values in turn
  size_t metadata_count;
  SphparamBytesAt file;
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

  /// Decodes a file in memory with the named decoder; `text` may take nothing. Returns 0, or 1
  /// after telling `error` why.
  int (*decode)(const char* format, const char* bytes, size_t size, SphparamImageLimits limits,
                SphparamPixelRoom room, SphparamTextSink text, SphparamBytesSink error);

  /// Opens a file; null after telling `error` why not. What `file` calls must live until `close`.
  void* (*open)(const SphparamImageFile* file, SphparamBytesSink error);
  /// The next rows; of tiled files whole rows of tiles, but at the end. Returns as `decode` does.
  int (*write_rows)(void* file, int first_row, int rows, const void* samples,
                    SphparamBytesSink error);
  /// Goes on with the next level of a tiled file. Returns as `decode` does.
  int (*next_level)(void* file, int width, int height, SphparamBytesSink error);
  /// Ends the file; with `give_up`, however it is. The file is gone afterwards in any case.
  int (*close)(void* file, int give_up, SphparamBytesSink error);

  /// Opens a file of our own of `size` bytes to read it back, without limits; null after telling
  /// `error` why not. `text` gets the texts of its metadata. What `bytes` calls must live until
  /// `close_written`.
  void* (*open_written)(const char* format, SphparamBytesFrom bytes, int64_t size,
                        SphparamTextSink text, SphparamBytesSink error);
  /// What a level is, from 0. Returns 1 where the file has no such level.
  int (*level_written)(void* file, int level, SphparamImageLevel* out);
  /// Rows as they are taken by `write_rows`. Returns as `decode` does.
  int (*read_rows)(void* file, int level, int first_row, int rows, void* samples,
                   SphparamBytesSink error);
  void (*close_written)(void* file);

  /// Encodes rows of 3 or 4 bytes a texel, alpha not multiplied in, as WebP. Returns as `decode`.
  int (*encode_webp)(const SphparamWebp* image, SphparamBytesSink bytes, SphparamBytesSink error);
};

/// The module's one exported name.
typedef const SphparamImageTable* (*SphparamImageTableFunction)();
}

constexpr int sphparam_image_table_version = 9;
/// What `error` is told where memory ran out, and nowhere else.
constexpr char sphparam_image_no_memory[] = "not enough memory";
/// The name under which `decode` tells, as a text, what profile colours are in, where it is not
/// that of sRGB.
constexpr char sphparam_other_profile[] = "sphparam:other-profile";
/// The name under which it tells, as a text, what a sample is: OpenImageIO's word, "uint8".
constexpr char sphparam_samples[] = "sphparam:samples";
/// The name of a text that tells of a JPEG without an end whose pixels are all there.
constexpr char sphparam_lacks_end[] = "sphparam:lacks-end";
constexpr char sphparam_image_table_name[] = "sphparam_image_table";
