#include "report/picture.hpp"

#include "report/html.hpp"
#include "show/page/base64.hpp"

namespace ballflow::report {

std::string figure(const Picture& picture, const std::string& words) {
  return "<figure class=\"picture\"><figcaption><strong>" + escaped(picture.title) + "</strong>" +
         (words.empty() ? "" : ": " + escaped(words)) + "</figcaption><img alt=\"" + escaped(picture.title) +
         "\" src=\"data:image/png;base64," + show::base64(picture.png) + "\"></figure>\n";
}

}  // namespace ballflow::report
