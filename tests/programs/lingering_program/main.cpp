/// A program whose first thread is dead while another one lives on, as one that was killed is for a while
/// where processors are busy and a thread of it has the lowest priority.

#include <chrono>
#include <pthread.h>
#include <thread>

int main() {
  std::thread([] { std::this_thread::sleep_for(std::chrono::minutes(5)); }).detach();
  pthread_exit(nullptr);
}
