#pragma once
#include "firmtouch/params/entry.hpp"

// The table of a controller, at compile time, from the rows of its parts. A part names groups:
//     using Parameters = params::Groups<params::SceneRows, MyWallRows>;
// A group is a struct with `static constexpr params::Entry kRows[]`. Parts may share groups.
namespace firmtouch::params {

template <class... Rows>
struct Groups {};

namespace detail {

template <uint32_t kSize>
struct Sorted {
  Entry row[kSize] = {};
  uint32_t count = 0;

  constexpr void add(const Entry& entry) {
    uint32_t at = count;
    while (at > 0 && row[at - 1].number > entry.number) --at;
    if (at > 0 && row[at - 1].number == entry.number) return;  // of a group that two parts share
    for (uint32_t i = count; i > at; --i) row[i] = row[i - 1];
    row[at] = entry;
    ++count;
  }
};

template <uint32_t kSize>
constexpr uint32_t size_of(const Entry (&)[kSize]) {
  return kSize;
}

template <class... Rows>
constexpr auto sort() {
  Sorted<(size_of(Rows::kRows) + ... + 0u)> sorted;
  const auto add = [&sorted](const Entry* rows, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) sorted.add(rows[i]);
  };
  (add(Rows::kRows, size_of(Rows::kRows)), ...);
  return sorted;
}

template <class... Lists>
struct Join {
  using Type = Groups<>;
};
template <class... A>
struct Join<Groups<A...>> {
  using Type = Groups<A...>;
};
template <class... A, class... B, class... Rest>
struct Join<Groups<A...>, Groups<B...>, Rest...> : Join<Groups<A..., B...>, Rest...> {};

template <class Group>
struct Sort;
template <class... A>
struct Sort<Groups<A...>> {
  static constexpr auto kSorted = sort<A...>();
};

template <uint32_t kSize, uint32_t kFrom>
constexpr Sorted<kSize> shorten(const Sorted<kFrom>& from) {
  Sorted<kSize> rows;
  for (uint32_t i = 0; i < kSize; ++i) rows.row[i] = from.row[i];
  rows.count = kSize;
  return rows;
}

constexpr bool is_sound(const Entry& row) {
  return row.number < kFirstOwn + kMaxOwn && row.name != nullptr && row.low < row.high &&
         row.initial >= row.low && row.initial <= row.high;
}

template <uint32_t kSize>
constexpr bool are_sound(const Sorted<kSize>& rows) {
  for (const Entry& row : rows.row)
    if (!is_sound(row)) return false;
  return true;
}

}  // namespace detail

/// The Groups of several parts.
template <class... Lists>
using Joined = typename detail::Join<Lists...>::Type;

/// The rows of several Groups, sorted by number, each once.
template <class... Lists>
class Composed {
  using Sort = detail::Sort<Joined<Lists...>>;
  static constexpr uint32_t kSize = Sort::kSorted.count;
  static constexpr detail::Sorted<kSize> kRows = detail::shorten<kSize>(Sort::kSorted);
  static_assert(detail::are_sound(kRows),
                "a number or a range of a row is wrong, or its initial value is out of its range");

 public:
  static constexpr Table kTable{kRows.row, kSize};
};

}  // namespace firmtouch::params
