// A control: reads behind the end of an array.
#include <vector>

int main(int argc, char**) {
  std::vector<int> three(3);
  return three.data()[argc + 2];
}
