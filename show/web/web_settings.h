#pragma once
/// Whether a show has a web page for its operator, and where.

#include <string>
#include <vector>

namespace stadion {

struct WebSettings {
  std::string address;             ///< [HOST:]PORT; empty: there is no page
  std::string tokenFile;           ///< its first line is the token; empty: one is made at the start
  std::vector<std::string> names;  ///< further host names of the page, as a proxy has
};

}  // namespace stadion
