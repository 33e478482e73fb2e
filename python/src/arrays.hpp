#pragma once
#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wavebalance::python {

/// A read-only view of numbers that `owner` keeps alive: shape and strides (bytes) as NumPy has them.
template <class Number>
pybind11::array view(const Number* data, std::vector<pybind11::ssize_t> shape,
                     std::vector<pybind11::ssize_t> strides, pybind11::handle owner) {
  pybind11::array array(pybind11::dtype::of<Number>(), std::move(shape), std::move(strides), data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Contact-major samples as contacts x points.
inline pybind11::array samples_view(const Eigen::VectorXd& samples, int contacts, pybind11::handle owner) {
  const auto points = static_cast<pybind11::ssize_t>(samples.size()) / contacts;
  const auto size = static_cast<pybind11::ssize_t>(sizeof(double));
  return view(samples.data(), {contacts, points}, {points * size, size}, owner);
}

/// A member of `count` consecutive structs in `owner`; `first` belongs to the first one.
template <class Struct, class Number>
pybind11::array member_view(const std::vector<Struct>& structs, const Number Struct::*member,
                            pybind11::handle owner) {
  static const Struct none{};
  const Struct& first = structs.empty() ? none : structs.front();
  return view(&(first.*member), {static_cast<pybind11::ssize_t>(structs.size())},
              {static_cast<pybind11::ssize_t>(sizeof(Struct))}, owner);
}

/// An array that owns the numbers, without a copy.
template <class Number>
pybind11::array owned(std::vector<Number> numbers) {
  auto kept = std::make_unique<std::vector<Number>>(std::move(numbers));
  const auto size = static_cast<pybind11::ssize_t>(kept->size());
  const Number* data = kept->data();
  const pybind11::capsule owner(kept.release(),
                                [](void* pointer) { delete static_cast<std::vector<Number>*>(pointer); });
  return pybind11::array_t<Number>({size}, {static_cast<pybind11::ssize_t>(sizeof(Number))}, data, owner);
}

/// The property of a class whose values are a member of structs that an instance has; -1 for each of `count`
/// where there are not as many.
template <class One, class Structs, class Member>
auto column_of(Structs structs, Member member) {
  return [=](const pybind11::object& self) -> pybind11::array {
    const One& one = self.cast<const One&>();
    const auto& all = std::invoke(structs, one);
    if (all.size() != one.size()) return owned(std::vector<int>(one.size(), -1));
    return member_view(all, member, self);
  };
}

/// A point of a curve, from 0; negative numbers count from the end. Raises IndexError.
template <class Point>
const Point& point_at(const std::vector<Point>& points, int index) {
  const auto count = static_cast<int>(points.size());
  if (index < -count || index >= count)
    throw pybind11::index_error("point " + std::to_string(index) + " of a curve of " + std::to_string(count));
  return points[static_cast<std::size_t>(index < 0 ? index + count : index)];
}

/// The statuses of structs as texts.
template <class Struct>
std::vector<std::string_view> statuses_of(const std::vector<Struct>& structs) {
  std::vector<std::string_view> words;
  for (const Struct& one : structs) words.push_back(to_string(one.status));
  return words;
}

}  // namespace wavebalance::python
