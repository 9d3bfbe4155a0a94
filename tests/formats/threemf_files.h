// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/zip_writer.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dismantle {

/// The mesh of a tetrahedron with a corner at the origin and edges of 10 along the axes; volume 1000/6.
inline const std::string kTetrahedronMesh =
    "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='10' y='0' z='0'/><vertex x='0' y='10' z='0'/>"
    "<vertex x='0' y='0' z='10'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/>"
    "<triangle v1='0' v2='1' v3='3'/><triangle v1='0' v2='3' v3='2'/><triangle v1='1' v2='2' v3='3'/>"
    "</triangles></mesh>";

/// The XML of a model part.
inline std::string threemf_model(const std::string& resources, const std::string& build,
                                 const std::string& unit = "millimeter") {
  return "<?xml version='1.0' encoding='UTF-8'?><model unit='" + unit +
         "' xmlns='http://schemas.microsoft.com/3dmanufacturing/core/2015/02' "
         "xmlns:m='http://schemas.microsoft.com/3dmanufacturing/material/2015/02' "
         "xmlns:p='http://schemas.microsoft.com/3dmanufacturing/production/2015/06'><resources>" +
         resources + "</resources><build>" + build + "</build></model>";
}

/// Writes a 3MF package of one model part, and of further files.
inline void write_3mf(const std::filesystem::path& file, const std::string& model,
                      std::vector<std::pair<std::string, std::string>> others = {}) {
  others.insert(others.begin(),
                {{"_rels/.rels",
                  "<?xml version='1.0'?><Relationships><Relationship Target='/3D/root.model' Id='r0' "
                  "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>"},
                 {"3D/root.model", model}});
  write_zip(file, others);
}

}  // namespace dismantle
