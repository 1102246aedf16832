#include "io/transition_names.h"

#include "io/character_set.h"

namespace adit::io {

std::optional<HorizontalKind> landxml_transition(const std::string& word) {
  const std::string type = lower_case(word);
  if (type == "clothoid") return HorizontalKind::clothoid;
  if (type == "bloss" || type == "revbloss") return HorizontalKind::bloss;
  if (type == "cosine" || type == "revcosine") return HorizontalKind::cosine;
  if (type == "sinusoid" || type == "revsinusoid") return HorizontalKind::sinusoid;
  if (type == "biquadratic" || type == "revbiquadratic") return HorizontalKind::biquadratic;
  if (type == "cubic" || type == "cubicparabola") return HorizontalKind::cubic_parabola;
  return std::nullopt;
}

std::optional<HorizontalKind> ifc_transition(const std::string& word) {
  if (word == "BLOSSCURVE") return HorizontalKind::bloss;
  if (word == "COSINECURVE") return HorizontalKind::cosine;
  if (word == "SINECURVE") return HorizontalKind::sinusoid;
  if (word == "HELMERTCURVE" || word == "BIQUADRATICPARABOLA") return HorizontalKind::biquadratic;
  return std::nullopt;
}

}  // namespace adit::io
