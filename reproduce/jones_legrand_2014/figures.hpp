#pragma once
#include "wavebalance/report/artefact.hpp"

/// The figures and tables of JL14, each a function that makes it.
namespace wavebalance::jl14 {

void reference(report::Artefact& artefact, int case_number);
void fig01(report::Artefact& artefact);
void fig02(report::Artefact& artefact);
void fig03(report::Artefact& artefact);
void fig04(report::Artefact& artefact);
void fig05(report::Artefact& artefact);
void fig06(report::Artefact& artefact);
void fig07(report::Artefact& artefact);
void fig08(report::Artefact& artefact);
void fig09(report::Artefact& artefact);
void fig10(report::Artefact& artefact);
void fig11(report::Artefact& artefact);
void fig12(report::Artefact& artefact);
void tab01(report::Artefact& artefact);
void tab02(report::Artefact& artefact);
void haar_readings(report::Artefact& artefact);
void rigid_plateau(report::Artefact& artefact);
void speed(report::Artefact& artefact);

}  // namespace wavebalance::jl14
