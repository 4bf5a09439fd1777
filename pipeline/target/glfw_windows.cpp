// The only file that knows GLFW.
#include "engine/base/shared_library.h"
#include "pipeline/gl/gl_table.h"
#include "pipeline/gl/problem.h"
#include "pipeline/target/screen_saver.h"
#include "pipeline/target/window.h"
#include "pipeline/target/x_connection.h"
#include "pipeline/target/x_pixels.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace stadion {
namespace {

#define STADION_GLFW_FUNCTIONS(X)                                                                            \
  X(CreateWindow)                                                                                            \
  X(DestroyWindow)                                                                                           \
  X(GetCursorPos)                                                                                            \
  X(GetError)                                                                                                \
  X(GetFramebufferSize)                                                                                      \
  X(GetGamepadState)                                                                                         \
  X(GetMonitorName)                                                                                          \
  X(GetMonitorPos)                                                                                           \
  X(GetMonitors)                                                                                             \
  X(GetProcAddress)                                                                                          \
  X(GetVideoMode)                                                                                            \
  X(GetWindowPos)                                                                                            \
  X(GetWindowSize)                                                                                           \
  X(GetWindowUserPointer)                                                                                    \
  X(Init)                                                                                                    \
  X(MakeContextCurrent)                                                                                      \
  X(PollEvents)                                                                                              \
  X(SetCursorEnterCallback)                                                                                  \
  X(SetCursorPosCallback)                                                                                    \
  X(SetFramebufferSizeCallback)                                                                              \
  X(SetInputMode)                                                                                            \
  X(SetKeyCallback)                                                                                          \
  X(SetMouseButtonCallback)                                                                                  \
  X(SetScrollCallback)                                                                                       \
  X(SetWindowCloseCallback)                                                                                  \
  X(SetWindowFocusCallback)                                                                                  \
  X(SetWindowIconifyCallback)                                                                                \
  X(SetWindowRefreshCallback)                                                                                \
  X(SetWindowPos)                                                                                            \
  X(SetWindowSizeCallback)                                                                                   \
  X(SetWindowTitle)                                                                                          \
  X(SetWindowUserPointer)                                                                                    \
  X(ShowWindow)                                                                                              \
  X(SwapBuffers)                                                                                             \
  X(SwapInterval)                                                                                            \
  X(Terminate)                                                                                               \
  X(WindowHint)

struct Glfw {
#define STADION_GLFW_MEMBER(name) decltype(&glfw##name) name = nullptr;
  STADION_GLFW_FUNCTIONS(STADION_GLFW_MEMBER)
#undef STADION_GLFW_MEMBER
};

// A callback of GLFW gets only the window; this returns our object for it. The function is the same in every
// copy of the library.
decltype(&glfwGetWindowUserPointer) ownerOf = nullptr;

Result<Glfw> loadGlfw(const SharedLibrary& library) {
  Glfw glfw;
  const char* missing = nullptr;
#define STADION_GLFW_LOAD(name)                                                                              \
  glfw.name = library.find<std::remove_pointer_t<decltype(glfw.name)>>("glfw" #name);                        \
  if (!glfw.name) missing = "glfw" #name;
  STADION_GLFW_FUNCTIONS(STADION_GLFW_LOAD)
#undef STADION_GLFW_LOAD
  if (missing) return Result<Glfw>::failure(fmt::format("libglfw.so.3 is too old: it has no {}", missing));
  return glfw;
}

std::string lastError(const Glfw& glfw) {
  const char* why = nullptr;
  glfw.GetError(&why);
  return why ? why : "no reason given";
}

Key keyOf(int code) {
  constexpr std::pair<int, Key> kNamed[] = {{GLFW_KEY_ESCAPE, Key::Escape},
                                            {GLFW_KEY_ENTER, Key::Enter},
                                            {GLFW_KEY_TAB, Key::Tab},
                                            {GLFW_KEY_LEFT, Key::Left},
                                            {GLFW_KEY_RIGHT, Key::Right},
                                            {GLFW_KEY_BACKSPACE, Key::Backspace},
                                            {GLFW_KEY_UP, Key::Up},
                                            {GLFW_KEY_DOWN, Key::Down},
                                            {GLFW_KEY_PAGE_UP, Key::PageUp},
                                            {GLFW_KEY_HOME, Key::Home},
                                            {GLFW_KEY_PAGE_DOWN, Key::PageDown}};
  for (const auto& [theirs, ours] : kNamed)
    if (code == theirs) return ours;
  if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12)
    return static_cast<Key>(static_cast<int>(Key::F1) + code - GLFW_KEY_F1);
  return code >= 32 && code < 127 ? static_cast<Key>(code) : Key::Unknown;
}

/// The places of the monitors, asked again once a second: they may be rearranged during a show.
class MonitorPlaces {
public:
  explicit MonitorPlaces(const Glfw& glfw) : glfw_(glfw) {}

  const std::vector<PixelRectangle>& now() {
    const auto clock = std::chrono::steady_clock::now();
    if (clock < due_) return places_;
    due_ = clock + std::chrono::seconds(1);
    places_.clear();
    int count = 0;
    GLFWmonitor** const all = glfw_.GetMonitors(&count);
    for (int i = 0; i < count; ++i) {
      PixelRectangle place;
      glfw_.GetMonitorPos(all[i], &place.x, &place.y);
      const GLFWvidmode* mode = glfw_.GetVideoMode(all[i]);
      if (!mode) continue;
      place.width = static_cast<std::uint32_t>(mode->width);
      place.height = static_cast<std::uint32_t>(mode->height);
      places_.push_back(place);
    }
    return places_;
  }

private:
  const Glfw& glfw_;
  std::vector<PixelRectangle> places_;
  std::chrono::steady_clock::time_point due_{};
};

/// Once the connection is lost, it must not be used any more; OpenGL output is discarded.
class GlfwContext final : public WindowContext {
public:
  GlfwContext(const Glfw& glfw, GLFWwindow* handle, const GlTable& gl, std::mutex& turns, std::uint32_t width,
              std::uint32_t height)
      : WindowContext(gl, turns, width, height), glfw_(glfw), handle_(handle) {}

  std::optional<Diagnostic> makeCurrent() override {
    if (const auto why = xConnectionLost()) return problem(*why);
    glfw_.GetError(nullptr);
    glfw_.MakeContextCurrent(handle_);
    const char* why = nullptr;
    if (glfw_.GetError(&why) == GLFW_NO_ERROR) return {};
    return problem(std::string("the window's context cannot be made current: ") + (why ? why : ""));
  }
  void release() override {
    if (!xConnectionLost()) glfw_.MakeContextCurrent(nullptr);
  }
  void swap() override {
    if (!xConnectionLost()) glfw_.SwapBuffers(handle_);
  }
  void waitForDisplay(bool wait) override { glfw_.SwapInterval(wait ? 1 : 0); }

private:
  const Glfw& glfw_;
  GLFWwindow* handle_;
};

class GlfwWindow final : public Window {
public:
  /// With one of `context` and `pixels`.
  GlfwWindow(const Glfw& glfw, GLFWwindow* handle, std::unique_ptr<GlfwContext> context,
             std::unique_ptr<XPixels> pixels, MonitorPlaces& monitors, ScreenSaverPause& saver)
      : glfw_(glfw), handle_(handle), context_(std::move(context)), pixels_(std::move(pixels)),
        monitors_(monitors), saver_(saver) {
    glfw_.SetWindowUserPointer(handle_, this);
    glfw_.SetKeyCallback(handle_, [](GLFWwindow* w, int key, int, int action, int mods) {
      WindowEvent e;
      e.kind = action == GLFW_REPEAT ? WindowEvent::Kind::KeyRepeat : WindowEvent::Kind::Key;
      e.key = keyOf(key);
      e.down = action != GLFW_RELEASE;
      e.shift = mods & GLFW_MOD_SHIFT;
      e.control = mods & GLFW_MOD_CONTROL;
      note(w, e);
    });
    glfw_.SetMouseButtonCallback(handle_, [](GLFWwindow* w, int button, int action, int mods) {
      WindowEvent e;
      e.kind = WindowEvent::Kind::Button;
      e.button = static_cast<std::uint32_t>(button);
      e.down = action == GLFW_PRESS;
      e.shift = mods & GLFW_MOD_SHIFT;
      note(w, e);
    });
    glfw_.SetCursorPosCallback(
        handle_, [](GLFWwindow* w, double x, double y) { note(w, at(WindowEvent::Kind::Move, x, y)); });
    glfw_.SetScrollCallback(
        handle_, [](GLFWwindow* w, double x, double y) { note(w, at(WindowEvent::Kind::Wheel, x, y)); });
    glfw_.SetCursorEnterCallback(handle_, [](GLFWwindow* w, int entered) {
      if (entered) note(w, at(WindowEvent::Kind::PointerEntered, 0, 0));
    });
    glfw_.SetWindowFocusCallback(handle_, [](GLFWwindow* w, int focused) {
      if (!focused) note(w, at(WindowEvent::Kind::FocusLost, 0, 0));
    });
    glfw_.SetWindowCloseCallback(handle_, [](GLFWwindow* w) { note(w, at(WindowEvent::Kind::Close, 0, 0)); });
    // Sizes are kept: GLFW does not say if it asks in vain, because the window or the server is gone, and
    // returns any number.
    glfw_.GetFramebufferSize(handle_, &pixelsAcross_, &pixelsDown_);
    glfw_.GetWindowSize(handle_, &across_, &down_);
    if (xConnectionLost()) pixelsAcross_ = pixelsDown_ = across_ = down_ = 1;
    glfw_.SetFramebufferSizeCallback(handle_, [](GLFWwindow* w, int width, int height) {
      GlfwWindow& window = *static_cast<GlfwWindow*>(ownerOf(w));
      window.pixelsAcross_ = width;
      window.pixelsDown_ = height;
    });
    glfw_.SetWindowSizeCallback(handle_, [](GLFWwindow* w, int width, int height) {
      GlfwWindow& window = *static_cast<GlfwWindow*>(ownerOf(w));
      window.across_ = width;
      window.down_ = height;
    });
    // A full screen that is restored takes its monitor again.
    glfw_.SetWindowIconifyCallback(handle_, [](GLFWwindow* w, int iconified) {
      if (!iconified) static_cast<GlfwWindow*>(ownerOf(w))->saver_.restoreTimeouts();
    });
    glfw_.SetWindowRefreshCallback(handle_, [](GLFWwindow* w) {
      const GlfwWindow& window = *static_cast<GlfwWindow*>(ownerOf(w));
      if (window.pixels_) window.pixels_->showAgain();
    });
  }
  ~GlfwWindow() override {
    pixels_.reset();
    if (!xConnectionLost()) glfw_.DestroyWindow(handle_);
  }

  GLFWwindow* handle() const { return handle_; }
  WindowContext* context() override { return context_.get(); }
  WindowPixels* pixels() override { return pixels_.get(); }
  std::array<std::uint32_t, 2> size() const override {
    return {static_cast<std::uint32_t>(std::max(pixelsAcross_, 1)),
            static_cast<std::uint32_t>(std::max(pixelsDown_, 1))};
  }
  std::vector<WindowEvent> takeEvents() override { return std::exchange(events_, {}); }
  void setTitle(const std::string& title) override { glfw_.SetWindowTitle(handle_, title.c_str()); }
  std::vector<MonitorPart> monitorParts() const override {
    const auto [width, height] = size();
    const MonitorPart atTop{{0, 0, width, height}, 0};
    if (xConnectionLost()) return {atTop};
    glfw_.GetError(nullptr);
    int x = 0, y = 0;
    glfw_.GetWindowPos(handle_, &x, &y);
    if (glfw_.GetError(nullptr) != GLFW_NO_ERROR) return {atTop};  // Wayland gives no position
    if (across_ <= 0 || down_ <= 0) return {atTop};
    const PixelRectangle content{x, y, static_cast<std::uint32_t>(across_),
                                 static_cast<std::uint32_t>(down_)};
    return partsOnMonitors(content, monitors_.now(), static_cast<double>(height) / down_);
  }

private:
  static WindowEvent at(WindowEvent::Kind kind, double x, double y) {
    WindowEvent e;
    e.kind = kind;
    e.x = x;
    e.y = y;
    return e;
  }
  static void note(GLFWwindow* window, const WindowEvent& event) {
    static_cast<GlfwWindow*>(ownerOf(window))->events_.push_back(event);
  }

  const Glfw& glfw_;
  GLFWwindow* handle_;
  std::unique_ptr<GlfwContext> context_;
  std::unique_ptr<XPixels> pixels_;
  MonitorPlaces& monitors_;
  ScreenSaverPause& saver_;
  std::vector<WindowEvent> events_;
  int pixelsAcross_ = 1, pixelsDown_ = 1;  ///< size [pixels]
  int across_ = 1, down_ = 1;              ///< size [units of the desktop]
};

using WindowNumber = unsigned long(GLFWwindow*);

class GlfwSystem final : public WindowSystem {
public:
  /// `display` is Xlib's Display, null for another window system; `windowOf` gives X's number of a window,
  /// `drawableOf` GLX's.
  GlfwSystem(const Glfw& glfw, void* display, WindowNumber* windowOf, WindowNumber* drawableOf)
      : glfw_(glfw), display_(windowOf ? display : nullptr), windowOf_(windowOf), drawableOf_(drawableOf),
        monitors_(glfw_), saver_(std::make_unique<ScreenSaverPause>(display)) {}
  ~GlfwSystem() override {
    saver_.reset();
    if (!xConnectionLost()) glfw_.Terminate();
  }

  Result<std::unique_ptr<Window>> create(const WindowPlan& plan) override {
    using Created = Result<std::unique_ptr<Window>>;
    GLFWmonitor* monitor = nullptr;
    if (!plan.monitor.empty() || plan.fullscreen) {
      monitor = find(plan.monitor);
      if (!monitor) return Created::failure(noSuch(plan.monitor));
    }
    const bool pixels = plan.surface == WindowSurface::Pixels && !plan.quadBuffer && display_;
    GLFWwindow* const handle = pixels ? make(plan, monitor, {}) : makeWithContext(plan, monitor);
    if (!handle)
      return Created::failure(
          fmt::format("no window{}{}: {}",
                      plan.quadBuffer ? " with a back buffer for each eye (quad-buffered stereo)" : "",
                      pixels ? "" : " with OpenGL 3.3 core", lastError(glfw_)));
    if (plan.fullscreen) saver_->restoreTimeouts();
    place(handle, plan, monitor);
    if (!plan.pointer) glfw_.SetInputMode(handle, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    auto made = pixels ? withPixels(handle) : withContext(handle);
    if (!made) glfw_.DestroyWindow(handle);
    return made;
  }

  Result<std::unique_ptr<SwapGroup>> joinSwapGroup(const std::vector<Window*>& windows,
                                                   bool barrier) override {
    using Joined = Result<std::unique_ptr<SwapGroup>>;
    auto functions = SwapGroupFunctions::ofDisplay(drawableOf_ ? display_ : nullptr);
    if (!functions) return functions.error();
    std::vector<SwapGroupFunctions::Drawable> drawables;
    for (Window* window : windows) {
      glfw_.GetError(nullptr);
      drawables.push_back(drawableOf_(static_cast<GlfwWindow*>(window)->handle()));
      if (drawables.back() == 0) return Joined::failure("a window has no GLX drawable: " + lastError(glfw_));
    }
    return SwapGroup::join(std::move(functions.value()), std::move(drawables), barrier);
  }

  void poll() override {
    if (xConnectionLost()) return;
    glfw_.PollEvents();
    saver_->poll(std::chrono::steady_clock::now());
  }
  std::optional<std::string> lost() const override { return xConnectionLost(); }
  std::optional<std::string> mayGoDark() const override { return saver_->shortcoming(); }

  std::optional<GamepadState> gamepad() override {
    GLFWgamepadstate raw;
    if (!glfw_.GetGamepadState(GLFW_JOYSTICK_1, &raw)) return {};
    GamepadState state;
    for (std::size_t i = 0; i < state.axes.size(); ++i) state.axes[i] = raw.axes[i];
    constexpr int kButtons[] = {GLFW_GAMEPAD_BUTTON_A,           GLFW_GAMEPAD_BUTTON_B,
                                GLFW_GAMEPAD_BUTTON_X,           GLFW_GAMEPAD_BUTTON_Y,
                                GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER};
    for (std::size_t i = 0; i < std::size(kButtons); ++i)
      if (raw.buttons[kButtons[i]] == GLFW_PRESS) state.buttons |= 1u << i;
    return state;
  }

  std::vector<std::string> monitors() override {
    std::vector<std::string> names;
    for (GLFWmonitor* m : all()) {
      const GLFWvidmode* mode = glfw_.GetVideoMode(m);
      names.push_back(fmt::format("{} ({} x {})", glfw_.GetMonitorName(m), mode ? mode->width : 0,
                                  mode ? mode->height : 0));
    }
    return names;
  }

  Result<std::string> pixelsWay() override {
    if (!display_) return Result<std::string>::failure("windows without OpenGL need an X server (XWayland)");
    const auto pixels = XPixels::open(display_);
    if (!pixels) return pixels.error();
    return pixels.value()->way();
  }

private:
  std::vector<GLFWmonitor*> all() {
    int count = 0;
    GLFWmonitor** first = glfw_.GetMonitors(&count);
    return {first, first + count};
  }

  /// Finds a monitor by name, or by number from 1; the first one if the name is empty.
  GLFWmonitor* find(const std::string& name) {
    const std::vector<GLFWmonitor*> there = all();
    for (std::size_t i = 0; i < there.size(); ++i)
      if (name.empty() || name == glfw_.GetMonitorName(there[i]) || name == std::to_string(i + 1))
        return there[i];
    return nullptr;
  }

  std::string noSuch(const std::string& name) {
    return fmt::format("there is no monitor {}; there are: {}", name.empty() ? "at all" : "\"" + name + "\"",
                       fmt::join(monitors(), ", "));
  }

  GLFWwindow* makeWithContext(const WindowPlan& plan, GLFWmonitor* monitor) {
    GLFWwindow* handle = nullptr;
    for (const auto& version : {std::pair(4, 5), std::pair(3, 3)})
      if (!handle) handle = make(plan, monitor, version);
    return handle;
  }

  /// Without a version: without OpenGL. GLFW then loads no library of it.
  GLFWwindow* make(const WindowPlan& plan, GLFWmonitor* monitor, std::optional<std::pair<int, int>> version) {
    const GLFWvidmode* mode = monitor ? glfw_.GetVideoMode(monitor) : nullptr;
    const auto [major, minor] = version.value_or(std::pair(1, 0));
    const std::pair<int, int> hints[] = {
        {GLFW_CLIENT_API, version ? GLFW_OPENGL_API : GLFW_NO_API},
        {GLFW_CONTEXT_VERSION_MAJOR, major},
        {GLFW_CONTEXT_VERSION_MINOR, minor},
        {GLFW_OPENGL_PROFILE, version ? GLFW_OPENGL_CORE_PROFILE : GLFW_OPENGL_ANY_PROFILE},
        {GLFW_OPENGL_FORWARD_COMPAT, version ? GLFW_TRUE : GLFW_FALSE},
        {GLFW_DEPTH_BITS, 0},
        {GLFW_STENCIL_BITS, 0},
        {GLFW_STEREO, plan.quadBuffer ? GLFW_TRUE : GLFW_FALSE},
        {GLFW_DECORATED, plan.frame ? GLFW_TRUE : GLFW_FALSE},
        {GLFW_RESIZABLE, plan.frame ? GLFW_TRUE : GLFW_FALSE},
        {GLFW_AUTO_ICONIFY, GLFW_FALSE},
        {GLFW_VISIBLE, plan.fullscreen ? GLFW_TRUE : GLFW_FALSE},
        {GLFW_REFRESH_RATE, plan.refresh > 0 ? static_cast<int>(plan.refresh) : GLFW_DONT_CARE}};
    for (const auto& [hint, value] : hints) glfw_.WindowHint(hint, value);
    const bool full = plan.fullscreen && mode;
    return glfw_.CreateWindow(full ? mode->width : static_cast<int>(plan.width),
                              full ? mode->height : static_cast<int>(plan.height), plan.title.c_str(),
                              full ? monitor : nullptr, nullptr);
  }

  void place(GLFWwindow* handle, const WindowPlan& plan, GLFWmonitor* monitor) {
    if (plan.fullscreen) return;
    int x = 0, y = 0;
    if (monitor) glfw_.GetMonitorPos(monitor, &x, &y);
    if (plan.placed || monitor) glfw_.SetWindowPos(handle, x + plan.x, y + plan.y);
    glfw_.ShowWindow(handle);
  }

  using MadeWindow = Result<std::unique_ptr<Window>>;

  MadeWindow withContext(GLFWwindow* handle) {
    if (const auto why = loadTable(handle)) return *why;
    int width = 0, height = 0;
    glfw_.GetFramebufferSize(handle, &width, &height);
    auto context = std::make_unique<GlfwContext>(
        glfw_, handle, gl_, turns_, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    return std::unique_ptr<Window>(
        std::make_unique<GlfwWindow>(glfw_, handle, std::move(context), nullptr, monitors_, *saver_));
  }

  MadeWindow withPixels(GLFWwindow* handle) {
    auto pixels = XPixels::open(display_, windowOf_(handle));
    if (!pixels) return pixels.error();
    return std::unique_ptr<Window>(
        std::make_unique<GlfwWindow>(glfw_, handle, nullptr, std::move(pixels.value()), monitors_, *saver_));
  }

  /// The functions are the same for all windows of a connection.
  std::optional<Diagnostic> loadTable(GLFWwindow* handle) {
    if (loaded_) return {};
    glfw_.MakeContextCurrent(handle);
    const auto table = loadGlTable(glfw_.GetProcAddress);
    glfw_.MakeContextCurrent(nullptr);
    if (!table) return table.error();
    gl_ = table.value();
    loaded_ = true;
    return {};
  }

  const Glfw glfw_;
  void* const display_;
  WindowNumber* const windowOf_;
  WindowNumber* const drawableOf_;
  MonitorPlaces monitors_;
  std::unique_ptr<ScreenSaverPause> saver_;
  GlTable gl_;
  std::mutex turns_;
  bool loaded_ = false;
};

/// Sets an environment variable during its lifetime; an empty value changes nothing.
class EnvironmentValue {
public:
  EnvironmentValue(const char* name, const std::string& value) : name_(name), set_(!value.empty()) {
    if (!set_) return;
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~EnvironmentValue() {
    if (!set_) return;
    before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_);
  }
  EnvironmentValue(const EnvironmentValue&) = delete;
  EnvironmentValue& operator=(const EnvironmentValue&) = delete;

private:
  const char* name_;
  bool set_;
  std::optional<std::string> before_;
};

}  // namespace

// GLFW keeps its one connection, to one screen of one display, in static memory. A further screen therefore
// gets a copy of the library.
Result<std::unique_ptr<WindowSystem>> WindowSystem::open(const std::string& screen) {
  using Opened = Result<std::unique_ptr<WindowSystem>>;
  const auto library = screen.empty() ? SharedLibrary::open("libglfw.so.3", "libglfw3")
                                      : SharedLibrary::openCopy("libglfw.so.3", "libglfw3");
  if (!library) return library.error();
  const auto glfw = loadGlfw(library.value());
  if (!glfw) return glfw.error();
  ownerOf = glfw.value().GetWindowUserPointer;
  const EnvironmentValue display("DISPLAY", screen);
  if (glfw.value().Init()) {
    // Only a GLFW for X has it.
    const auto connection = library.value().find<void*()>("glfwGetX11Display");
    void* const xDisplay = connection ? connection() : nullptr;
    watchXConnection(xDisplay);
    return std::unique_ptr<WindowSystem>(std::make_unique<GlfwSystem>(
        glfw.value(), xDisplay, library.value().find<WindowNumber>("glfwGetX11Window"),
        library.value().find<WindowNumber>("glfwGetGLXWindow")));
  }
  if (!screen.empty())
    return Opened::failure(
        fmt::format("the screen {} cannot be opened ({})", screen, lastError(glfw.value())));
  return Opened::failure(fmt::format("there is no display ({}); set DISPLAY, such as DISPLAY=:0, or draw "
                                     "without a window: stadion run SHOW --out DIR",
                                     lastError(glfw.value())));
}

}  // namespace stadion
