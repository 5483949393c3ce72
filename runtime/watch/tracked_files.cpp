#include "runtime/watch/tracked_files.hpp"

#include <sys/vfs.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "runtime/watch/scene_folder.hpp"

namespace scenec::runtime {

std::vector<std::string> TrackedFiles::set(Owner owner, const std::vector<FileRecord>& records) {
  for (auto& [path, entry] : files_) entry.read.erase(owner);
  std::vector<std::string> doubtful;
  for (const FileRecord& record : records) {
    const State state{record.found, record.hash};
    const auto [place, added] = files_.try_emplace(record.path);
    if (added) place->second.seen = state;
    // A new one may have changed between its being read and being watched.
    if (added || place->second.seen != state) doubtful.push_back(record.path);
    place->second.read[owner] = state;
  }
  std::erase_if(files_, [](const auto& entry) { return entry.second.read.empty(); });
  for (auto& [path, entry] : files_) {
    if (!entry.read.contains(owner)) entry.reported.erase(owner);
  }
  return doubtful;
}

TrackedFiles::State TrackedFiles::look(const std::string& path) {
  if (is_listing(path)) {
    const FileRecord listing = listing_of(path);
    return {listing.found, listing.hash};
  }
  RealFileSystem disk;
  const auto content = disk.read(path, std::numeric_limits<std::int64_t>::max());
  if (!content) return {};
  return {true, hash_bytes(content.value().bytes)};
}

bool TrackedFiles::same(const State& read, const State& now) {
  const bool only_there = read.found && read.hash == Hash128{};
  return only_there ? read.found == now.found : read == now;
}

// Told once a state: a file that cannot be read for another reason than its bytes (it lies outside
// the root) would be reported for ever.
bool TrackedFiles::is_news(const Entry& entry, Owner owner, const State& now) {
  if (same(entry.read.at(owner), now)) return false;
  const auto told = entry.reported.find(owner);
  return told == entry.reported.end() || told->second != now;
}

bool TrackedFiles::has_changed(const std::string& path) const {
  const auto entry = files_.find(path);
  if (entry == files_.end()) return false;
  const State now = look(path);
  return std::any_of(entry->second.read.begin(), entry->second.read.end(),
                     [&](const auto& owner) { return is_news(entry->second, owner.first, now); });
}

std::set<TrackedFiles::Owner> TrackedFiles::find_changed(const std::set<std::string>& paths) {
  std::set<Owner> changed;
  for (const std::string& path : paths) {
    const auto found = files_.find(path);
    if (found == files_.end()) continue;
    Entry& entry = found->second;
    const State now = look(path);
    entry.seen = now;
    for (const auto& [owner, read] : entry.read) {
      if (is_news(entry, owner, now)) changed.insert(owner);
      if (same(read, now)) {
        entry.reported.erase(owner);
      } else {
        entry.reported[owner] = now;
      }
    }
  }
  return changed;
}

void TrackedFiles::look_up_places() {
  directories_.clear();
  files_at_.clear();
  for (auto& [path, entry] : files_) {
    entry.places = places_of(path);
    if (is_listing(path)) {  // of the entries in it, whatever their names
      std::error_code error;
      const std::string directory = std::filesystem::canonical(path, error).string();
      if (!error) entry.places.push_back({directory, ""});
    }
    for (const Place& place : entry.places) {
      files_at_[place].insert(path);
      directories_.try_emplace(place.directory, Attention::entries);
    }
    if (!entry.places.empty()) directories_[entry.places.back().directory] = Attention::writes;
  }
}

std::set<std::string> TrackedFiles::listings_of(const std::string& directory) const {
  const auto found = files_at_.find({directory, ""});
  return found == files_at_.end() ? std::set<std::string>{} : found->second;
}

std::set<std::string> TrackedFiles::files_at(const Place& place) const {
  if (!place.name.empty()) {
    const auto found = files_at_.find(place);
    return found == files_at_.end() ? std::set<std::string>{} : found->second;
  }
  std::set<std::string> all;
  for (auto at = files_at_.lower_bound({place.directory, ""});
       at != files_at_.end() && at->first.directory == place.directory; ++at) {
    all.insert(at->second.begin(), at->second.end());
  }
  return all;
}

std::set<std::string> TrackedFiles::files_to_poll(const std::vector<std::string>& unwatched) const {
  std::map<std::string, bool> remote;
  std::set<std::string> result;
  for (const auto& [path, entry] : files_) {
    for (const Place& place : entry.places) {
      const auto [known, added] = remote.try_emplace(place.directory, false);
      if (added) {
        known->second = is_remote(place.directory) || std::find(unwatched.begin(), unwatched.end(),
                                                                place.directory) != unwatched.end();
      }
      if (known->second) result.insert(path);
    }
  }
  return result;
}

std::set<std::string> TrackedFiles::all() const {
  std::set<std::string> paths;
  for (const auto& [path, entry] : files_) paths.insert(path);
  return paths;
}

std::set<TrackedFiles::Owner> TrackedFiles::owners_of(const std::set<std::string>& paths) const {
  std::set<Owner> owners;
  for (const std::string& path : paths) {
    const auto entry = files_.find(path);
    if (entry == files_.end()) continue;
    for (const auto& [owner, read] : entry->second.read) owners.insert(owner);
  }
  return owners;
}

bool is_remote(const std::string& directory) {
  // From <linux/magic.h> and statfs(2); not all of them have a name in the headers of Debian 12.
  constexpr std::array<std::uint32_t, 10> remote_kinds{
      0x6969,      // NFS
      0x517B,      // SMB
      0xFF534D42,  // CIFS
      0xFE534D42,  // SMB2
      0x01021997,  // 9p
      0x65735546,  // FUSE
      0x5346414F,  // AFS
      0x00C36400,  // Ceph
      0x786F4256,  // shared folder of VirtualBox
      0x73757245,  // Coda
  };
  struct statfs status{};
  if (::statfs(directory.c_str(), &status) != 0) return false;
  const auto kind = static_cast<std::uint32_t>(status.f_type);
  return std::find(remote_kinds.begin(), remote_kinds.end(), kind) != remote_kinds.end();
}

}  // namespace scenec::runtime
