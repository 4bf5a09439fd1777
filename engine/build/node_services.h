#pragma once
/// What the makers of nodes share while one show is built: fitted shapes, for instance. One object per type,
/// made when it is first asked for, unless it was put there before.
///
///     auto& shapes = request.services.get<ShapeStore>();
///
/// Threads  the loader's.

#include <map>
#include <memory>
#include <typeindex>
#include <utility>

namespace stadion {

class NodeServices {
public:
  template <class T>
  T& get() {
    std::shared_ptr<void>& place = all_[typeid(T)];
    if (!place) place = std::make_shared<T>();
    return *static_cast<T*>(place.get());
  }
  template <class T>
  void set(T service) {
    all_[typeid(T)] = std::make_shared<T>(std::move(service));
  }

private:
  std::map<std::type_index, std::shared_ptr<void>> all_;
};

}  // namespace stadion
