#pragma once
#include "wavebalance/report/artefact.hpp"

/// The figures of LL10, each a function that makes it.
namespace wavebalance::ll10 {

void fig01(report::Artefact& artefact);
void fig02(report::Artefact& artefact);
void fig03(report::Artefact& artefact);
void fig03_sampling(report::Artefact& artefact);
void algorithms(report::Artefact& artefact);
void fig04(report::Artefact& artefact);
void fig05(report::Artefact& artefact);
void fig06(report::Artefact& artefact);
void fig07(report::Artefact& artefact);
void fig08(report::Artefact& artefact);

}  // namespace wavebalance::ll10
