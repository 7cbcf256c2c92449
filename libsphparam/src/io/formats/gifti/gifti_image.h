#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <string>

#include "sphparam/io/vertex_data.h"

extern "C" {  // which the header forgets
#include <gifti/gifti_io.h>
}

namespace sphparam {

// What is handed to libgiftiio. It owns what is hung into its image, so all of it comes from
// malloc.

struct FreeGiftiImage {
  void operator()(gifti_image* image) const { gifti_free_image(image); }
};
using GiftiImage = std::unique_ptr<gifti_image, FreeGiftiImage>;

/// Memory that libgiftiio will free.
template <class Number>
Number* gifti_zeros(std::size_t count) {
  auto* const numbers =
      static_cast<Number*>(std::calloc(std::max<std::size_t>(count, 1), sizeof(Number)));
  if (!numbers) throw std::bad_alloc();
  return numbers;
}

/// Fills one array of rows, each of `columns` numbers; of one dimension where that is 1.
template <class Number, class From>
void fill_gifti(giiDataArray& array, int intent, int type, std::span<const From> numbers,
                int columns) {
  array.intent = intent;
  array.datatype = type;
  array.ind_ord = GIFTI_IND_ORD_ROW_MAJOR;
  array.num_dim = columns == 1 ? 1 : 2;
  array.dims[0] = static_cast<int>(numbers.size()) / columns;
  if (columns > 1) array.dims[1] = columns;
  array.encoding = GIFTI_ENCODING_B64GZ;
  array.endian = gifti_get_this_endian();
  array.nvals = static_cast<long long>(numbers.size());
  array.nbyper = sizeof(Number);
  auto* const copy = gifti_zeros<Number>(numbers.size());
  array.data = copy;
  std::transform(numbers.begin(), numbers.end(), copy,
                 [](From number) { return static_cast<Number>(number); });
}

/// Replaces the value of a key; an empty one is left out.
void add_gifti_metadata(giiMetaData& metadata, const std::string& key, const std::string& value);

/// The label table. None is left as it is.
void add_gifti_labels(gifti_image& image, std::span<const Label> labels);

/// `count` arrays that are to be filled. Throws: std::bad_alloc.
GiftiImage make_gifti_image(int count);

/// The bytes of the file. Throws: WriteError when libgiftiio fails.
std::string gifti_bytes(const gifti_image& image);

/// The state of libgiftiio is global: one caller at a time, from making an image to its bytes.
class GiftiTurn {
 public:
  GiftiTurn();

 private:
  std::lock_guard<std::mutex> lock_;
};

}  // namespace sphparam
