#include "io/msh_layout.h"

#include <array>

namespace isorelax {

std::optional<MshElementType> msh_element_type(std::int64_t number) {
  // Gmsh reference manual, "MSH file format", numbers from 1 on.
  static constexpr std::array<MshElementType, 31> kTypes{
      {{2, 1, 1},  {3, 2, 1},  {4, 2, 1},  {4, 3, 1},  {8, 3, 1},  {6, 3, 1},  {5, 3, 1},  {3, 1, 2},
       {6, 2, 2},  {9, 2, 2},  {10, 3, 2}, {27, 3, 2}, {18, 3, 2}, {14, 3, 2}, {1, 0, 1},  {8, 2, 2},
       {20, 3, 2}, {15, 3, 2}, {13, 3, 2}, {9, 2, 3},  {10, 2, 3}, {12, 2, 4}, {15, 2, 4}, {15, 2, 5},
       {21, 2, 5}, {4, 1, 3},  {5, 1, 4},  {6, 1, 5},  {20, 3, 3}, {35, 3, 4}, {56, 3, 5}}};
  if (number == 92) return MshElementType{64, 3, 3};
  if (number == 93) return MshElementType{125, 3, 4};
  if (number < 1 || number > static_cast<std::int64_t>(kTypes.size())) return std::nullopt;
  return kTypes[static_cast<std::size_t>(number - 1)];
}

}  // namespace isorelax
