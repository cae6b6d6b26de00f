#include "spring_workbench/ros/common/unsent_messages.h"

#include <arpa/inet.h>
#include <linux/sockios.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <poll.h>
#include <ros/header.h>
#include <ros/publication.h>
#include <ros/this_node.h>
#include <ros/topic_manager.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <optional>
#include <set>
#include <vector>

namespace spring_workbench::ros_common {
namespace {

/// A TCP connection to a subscriber.
struct Connection {
  int id = 0;
  std::string subscriber;
  int socket = -1, port = 0;  ///< port of the subscriber
};

/// The TCP connections of a topic, as roscpp describes them: "TCPROS connection on port 1 to [address:port on socket
/// 2]".
std::vector<Connection> connections_of(ros::Publication& publication) {
  XmlRpc::XmlRpcValue all;
  all.setSize(0);
  publication.getInfo(all);
  std::vector<Connection> result;
  for (int i = 0; i < all.size(); ++i) {
    const std::string text = all[i][6];
    const std::size_t socket = text.rfind(" on socket "), port = text.rfind(':', socket);
    Connection connection;
    connection.id = all[i][0];
    connection.subscriber = static_cast<std::string&>(all[i][1]);
    if (socket != std::string::npos && port != std::string::npos &&
        std::sscanf(text.c_str() + port, ":%d on socket %d", &connection.port, &connection.socket) == 2)
      result.push_back(connection);
  }
  return result;
}

/// Number of bytes that precede the messages of a connection: its header, with the same fields as roscpp's.
std::int64_t bytes_before_messages(ros::Publication& publication) {
  const ros::M_string fields{{"type", publication.getDataType()},
                             {"md5sum", publication.getMD5Sum()},
                             {"message_definition", publication.getMessageDefinition()},
                             {"callerid", ros::this_node::getName()},
                             {"latching", publication.isLatching() ? "1" : "0"},
                             {"topic", publication.getName()}};
  boost::shared_array<std::uint8_t> buffer;
  std::uint32_t size = 0;
  ros::Header::write(fields, buffer, size);
  return static_cast<std::int64_t>(sizeof(size)) + size;
}

/// What was put into the queue of a topic's connection so far.
std::optional<ConnectionFigures> queued(ros::Publication& publication, int id) {
  XmlRpc::XmlRpcValue statistics = publication.getStats();
  for (int i = 0; i < statistics[1].size(); ++i) {
    XmlRpc::XmlRpcValue& connection = statistics[1][i];
    if (static_cast<int&>(connection[0]) != id) continue;
    ConnectionFigures figures;
    figures.bytes = static_cast<std::uint32_t>(static_cast<int&>(connection[1]));
    figures.messages = static_cast<std::uint32_t>(static_cast<int&>(connection[3]));
    return figures;
  }
  return std::nullopt;
}

/// Bytes that the receiver's system has acknowledged.
std::optional<std::uint64_t> acknowledged(int socket) {
  tcp_info info{};
  socklen_t size = sizeof(info);
  if (getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return std::nullopt;
  if (size < offsetof(tcp_info, tcpi_bytes_acked) + sizeof(info.tcpi_bytes_acked)) return std::nullopt;
  return info.tcpi_bytes_acked;
}

/// roscpp may have closed the socket meanwhile, and the system used its number again.
bool is_open(const Connection& connection) {
  sockaddr_in6 peer{};  // its port is where that of sockaddr_in is
  socklen_t size = sizeof(peer);
  if (getpeername(connection.socket, reinterpret_cast<sockaddr*>(&peer), &size) != 0) return false;
  return ntohs(peer.sin6_port) == connection.port;
}

/// Adds what the system says of a connection; returns whether it is of one instant.
bool add_written(const Connection& connection, ConnectionFigures& figures) {
  int unacknowledged = 0;
  const auto before = acknowledged(connection.socket);
  if (!before || ioctl(connection.socket, SIOCOUTQ, &unacknowledged) != 0) return false;
  if (acknowledged(connection.socket) != before || !is_open(connection)) return false;
  pollfd room{connection.socket, POLLOUT, 0};
  poll(&room, 1, 0);
  figures.blocked = (room.revents & POLLOUT) == 0;
  figures.written = static_cast<std::int64_t>(*before) + unacknowledged;
  return true;
}

}  // namespace

const std::map<std::string, double>& UnsentMessages::update() {
  ros::V_string topics;
  ros::TopicManager::instance()->getAdvertisedTopics(topics);
  std::set<int> open;
  for (const std::string& topic : topics) {
    const ros::PublicationPtr publication = ros::TopicManager::instance()->lookupPublication(topic);
    if (!publication || publication->getMaxQueue() == 0 || !publication->hasSubscribers()) continue;
    const std::int64_t header = bytes_before_messages(*publication);
    for (const Connection& connection : connections_of(*publication)) {
      open.insert(connection.id);
      std::optional<ConnectionFigures> figures = queued(*publication, connection.id);
      if (!figures || !add_written(connection, *figures)) continue;
      figures->written -= header;
      const std::optional<ConnectionFigures> after = queued(*publication, connection.id);
      if (!after || after->messages != figures->messages) continue;  // not of one instant: next time
      DroppedMessages& dropped = connections_.try_emplace(connection.id, publication->getMaxQueue()).first->second;
      const double more = dropped.observe(*figures);
      if (more > 0.0) unsent_[topic + " to " + connection.subscriber] += more;
    }
  }
  for (auto each = connections_.begin(); each != connections_.end();)
    each = open.count(each->first) > 0 ? std::next(each) : connections_.erase(each);
  return unsent_;
}

}  // namespace spring_workbench::ros_common
