#include "host_sim/controllers/asset_file.hpp"

#include <cstring>

#include "firmtouch/asset/layout.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {

AssetFile::AssetFile(const std::string& path) : path_(path) {
  const std::string bytes = read_file(path);
  if (bytes.size() > UINT32_MAX) throw Refused(path + ": an asset has less than 4 GB");
  uint32_t magic = 0;
  if (bytes.size() >= sizeof magic) std::memcpy(&magic, bytes.data(), sizeof magic);
  if (magic != asset::kMagic)
    throw Refused(path + ": it is no asset; `firmtouch bake` makes one (.fta) of a model");
  size_ = static_cast<uint32_t>(bytes.size());
  blocks_.resize(bytes.size() / sizeof(Block) + 1);
  std::memcpy(blocks_.data(), bytes.data(), bytes.size());
}

core::Bytes AssetFile::bytes() const { return {blocks_.front().bytes, size_}; }

}  // namespace firmtouch::host_sim
