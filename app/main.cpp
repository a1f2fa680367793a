#include "cli/command.h"

int main(int argc, char** argv) {
  return isorelax::cli::run(argc, argv);
}
