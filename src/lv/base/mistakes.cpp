#include "lv/base/mistakes.hpp"

namespace lv {

void Mistakes::raise() const {
  if (found_.empty())
    return;
  std::string text = std::string(found_.front().what()).substr(found_.front().where().size() + 2);
  for (std::size_t i = 1; i < found_.size(); ++i)
    text += std::string("\n") + found_[i].what();
  throw InputError(found_.front().where(), text, "");
}

}  // namespace lv
