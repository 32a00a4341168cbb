#pragma once
// The real viewer on a virtual screen, driven by keys and mouse.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace boxwood::test {

inline bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

/// Starts a program with its output in a file; stopped at the end of life.
class Child {
 public:
  Child(const std::vector<std::string>& words, const std::filesystem::path& output, const std::string& display) {
    pid_ = fork();
    if (pid_ != 0) return;
    if (display.empty()) {
      unsetenv("DISPLAY");
      unsetenv("WAYLAND_DISPLAY");
    } else {
      setenv("DISPLAY", display.c_str(), 1);
    }
    if (!freopen(output.c_str(), "w", stdout) || dup2(1, 2) < 0) _exit(126);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ~Child() {
    if (pid_ <= 0) return;
    kill(pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Exit code; waits.
  int result() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Waits for a minute at most until `done()`; whether it came to that.
template <class Done>
bool wait_until(const Done& done) {
  for (int i = 0; i < 1200; ++i) {
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

/// A virtual screen of 640 x 480 with a viewer that fills it.
class WindowSession {
 public:
  explicit WindowSession(const std::vector<std::string>& arguments) {
    folder_ = std::filesystem::temp_directory_path() / ("boxwood-window-" + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    // The server picks a free display and writes its number.
    screen_ = std::make_unique<Child>(
        std::vector<std::string>{"sh", "-c", "exec Xvfb -displayfd 1 -screen 0 640x480x24 -nolisten tcp 2>/dev/null"},
        folder_ / "screen", ":0");
    wait_until([&] { return text_of(folder_ / "screen").find('\n') != std::string::npos; });
    std::string number = text_of(folder_ / "screen");
    display_ = ":" + number.substr(0, number.find('\n'));
    std::vector<std::string> words{BOXWOOD_VIEWER};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.insert(words.end(), {"--size", "640x480", "--folder", folder_.string(), "--threads", "1"});
    viewer_ = std::make_unique<Child>(words, folder_ / "output", display_);
    wait_until([&] { return said("ready"); });
  }
  ~WindowSession() {
    viewer_.reset();
    screen_.reset();
    std::filesystem::remove_all(folder_);
  }

  std::string output() const { return text_of(folder_ / "output"); }
  bool said(const std::string& words) const { return output().find(words) != std::string::npos; }
  std::filesystem::path folder() const { return folder_; }
  /// Arguments of xdotool.
  void tell(const std::string& what) const {
    std::system(("DISPLAY=" + display_ + " xdotool " + what + " >/dev/null 2>&1").c_str());
  }
  /// Presses a key and waits for the answer; whether it came.
  bool press(const std::string& key, const std::string& answer) const {
    const std::size_t before = output().size();
    tell("key " + key);
    return wait_until([&] { return output().substr(before).find(answer) != std::string::npos; });
  }

 private:
  std::filesystem::path folder_;
  std::string display_;
  std::unique_ptr<Child> screen_, viewer_;
};

}  // namespace boxwood::test
