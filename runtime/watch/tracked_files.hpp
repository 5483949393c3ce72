// The files scenes are made from, as last seen: whether each could be read, and the hash of its
// bytes. What was looked for and not found belongs to them: its appearance may mend a scene.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/file_system.hpp"
#include "runtime/watch/directory_events.hpp"
#include "runtime/watch/watch_places.hpp"

namespace scenec::runtime {

class TrackedFiles {
 public:
  using Owner = std::size_t;

  // `owner` has read these files as the records say; they replace those it had before. Returns the
  // files whose records differ from what was last seen of them, to be looked at.
  std::vector<std::string> set(Owner owner, const std::vector<FileRecord>& records);

  // Looks at the file: whether some owner is to be told. Tells nobody.
  [[nodiscard]] bool has_changed(const std::string& path) const;
  // Looks at these files; the owners of those that are not what the owner has read, each
  // difference once.
  [[nodiscard]] std::set<Owner> find_changed(const std::set<std::string>& paths);

  // Where changes of the files show, as paths lead now.
  void look_up_places();
  [[nodiscard]] const std::map<std::string, Attention>& directories() const { return directories_; }
  // The files whose path leads through this entry; with an empty name: through this directory.
  [[nodiscard]] std::set<std::string> files_at(const Place& place) const;
  // The listings (scene_folder.hpp) of this directory.
  [[nodiscard]] std::set<std::string> listings_of(const std::string& directory) const;
  // Files with an entry in one of these directories, or on a file system that does not tell what
  // other machines change.
  [[nodiscard]] std::set<std::string> files_to_poll(
      const std::vector<std::string>& unwatched) const;

  [[nodiscard]] std::set<std::string> all() const;
  [[nodiscard]] std::set<Owner> owners_of(const std::set<std::string>& paths) const;

 private:
  struct State {
    bool found = false;
    Hash128 hash;  // zero: only its being there matters
    friend bool operator==(const State&, const State&) = default;
  };
  struct Entry {
    std::map<Owner, State> read;      // what each owner has read
    std::map<Owner, State> reported;  // what each owner was last told of
    State seen;
    std::vector<Place> places;
  };
  [[nodiscard]] static State look(const std::string& path);
  // What the owner does not know yet.
  [[nodiscard]] static bool is_news(const Entry& entry, Owner owner, const State& now);
  [[nodiscard]] static bool same(const State& read, const State& now);

  std::map<std::string, Entry> files_;
  std::map<std::string, Attention> directories_;
  std::map<Place, std::set<std::string>> files_at_;
};

// Whether changes made elsewhere to files in this directory go unnoticed here (NFS, SMB, 9p, FUSE).
[[nodiscard]] bool is_remote(const std::string& directory);

}  // namespace scenec::runtime
