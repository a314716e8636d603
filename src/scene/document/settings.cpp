#include "scene/document/settings.h"

#include "scene/document/record.h"

namespace viete::scene {

void put_settings(Document& document, const RequestedSettings& asked, bool chosen) {
  const deform::Scheme scheme = deform::scheme_of(asked, document.scheme, chosen);
  if (asked.method) document.put_method(*asked.method);
  document.put_scheme(scheme);
}

}  // namespace viete::scene
