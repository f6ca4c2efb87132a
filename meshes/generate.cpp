// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes every test shape as a .ply file: generate_meshes OUTDIR [NAME...]
#include <exception>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>

#include "shapes.h"
#include "write_ply.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: generate_meshes OUTDIR [NAME...]   (no name: all shapes)\n";
    return 2;
  }
  try {
    const std::filesystem::path folder(argv[1]);
    std::filesystem::create_directories(folder);
    std::set<std::string> wanted(argv + 2, argv + argc);
    const bool all = wanted.empty();
    for (const auto& shape : dcharts::shapes::AllShapes()) {
      if (!all && wanted.erase(shape.name) == 0) continue;
      dcharts::shapes::WritePly(shape.mesh, (folder / (shape.name + ".ply")).string());
      std::cout << shape.name << ": " << shape.description << ", " << shape.mesh.faces.size() << " faces\n";
    }
    for (const auto& name : wanted) std::cerr << "There is no shape named " << name << ".\n";
    return wanted.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
